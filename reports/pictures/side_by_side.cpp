#include "reports/pictures/side_by_side.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "analysis/printed_metric.h"
#include "analysis/variant_comparison.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/worker_team.h"
#include "records/estimate.h"
#include "records/metric_value.h"
#include "reports/drawing/color_maps.h"
#include "reports/pictures/drawn_before.h"
#include "reports/pictures/picture_source.h"
#include "reports/pictures/picture_window.h"
#include "sequence/sequence.h"

namespace vitruvia {
namespace {

constexpr double kSheetMargin = 1.15;  // of a picture over the body in it

struct NamedRun {
  std::string name;  // what tells it from the other contenders
  const RunRecord* run;
};
using RunsOfSequence = std::vector<NamedRun>;

// In the order of the grid.
std::vector<RunsOfSequence> GroupedBySequence(const ReportedExperiment& experiment) {
  std::vector<RunsOfSequence> groups;
  const std::vector<Contender> contenders = ContendersOf(experiment);
  for (const RunRecord* run : experiment.finished()) {
    if (RepeatOf(*run) > 1) continue;  // the same again
    std::string name;
    for (const Contender& contender : contenders) {
      const auto& runs = contender.runs;
      if (std::find(runs.begin(), runs.end(), run) != runs.end()) name = contender.name;
    }
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const RunsOfSequence& runs) {
      return runs.front().run->sequence_folder == run->sequence_folder;
    });
    if (group == groups.end()) {
      groups.push_back({{name, run}});
    } else {
      group->push_back({name, run});
    }
  }
  std::erase_if(groups, [](const RunsOfSequence& runs) { return runs.size() < 2; });
  return groups;
}

std::vector<Color> FrontAndBack(const TriangleMesh& rest) {
  std::vector<Vector3f> normals;
  ComputeVertexNormals(rest.vertices, rest.triangles, normals);
  std::vector<Color> colors;
  for (const Vector3f& normal : normals) {
    colors.push_back(normal.z() > 0.0f ? kFrontColor : kBackColor);
  }
  return colors;
}

std::string NoteOf(const RunRecord& run) {
  std::string note;
  for (const Metric& metric : MetricsShownIn(Place::kPictureNote)) {
    const double value = MetricValue(run, metric);
    if (std::isnan(value)) continue;
    note += fmt::format("{}{} {}{}", note.empty() ? "" : " · ", metric.label,
                        Printed(value, metric), metric.unit.empty() ? "" : " " + metric.unit);
  }
  return note;
}

// Draws the rows of one sequence.
class RowPainter {
 public:
  RowPainter(const SequenceReader& sequence, const std::vector<int>& frames, MeshView& view)
      : sequence_(sequence), view_(view), camera_(sequence.info().camera) {
    double extent_m = 0.0;
    for (const int frame : FramesToShow(frames, sequence.info().frames)) {
      Shown& shown = frames_.emplace_back();
      shown.frame = frame;
      shown.truth = sequence.ReadTrueVertices(frame);
      const double one_meter = Pixels(camera_, 1.0, Middle(shown.truth)) / kSheetMargin;
      extent_m = std::max(extent_m, Projected(camera_, shown.truth).extent() / one_meter);
      range_.Include(sequence.ReadDepth(frame));
    }
    for (Shown& shown : frames_) {
      shown.part =
          Centered(Projected(camera_, shown.truth), Pixels(camera_, extent_m, Middle(shown.truth)));
    }
  }

  bool empty() const { return frames_.empty(); }
  const DepthRange& range() const { return range_; }

  std::vector<std::string> Titles() const {
    std::vector<std::string> titles;
    for (const Shown& shown : frames_) {
      titles.push_back(
          fmt::format("frame {}, {:.2f} s", shown.frame, shown.frame / sequence_.info().fps));
    }
    return titles;
  }

  PictureStrip Depth() const {
    PictureStrip strip;
    strip.label = "depth";
    for (const Shown& shown : frames_) {
      strip.pictures.emplace_back(DepthPicture(sequence_.ReadDepth(shown.frame), shown.part,
                                               kPictureSize, range_.nearest_m(),
                                               range_.farthest_m()));
    }
    return strip;
  }

  PictureStrip Truth() {
    PictureStrip strip;
    strip.label = "truth";
    const TriangleMesh& rest = sequence_.true_rest_mesh();
    for (const Shown& shown : frames_) Paint(shown, shown.truth, rest, FrontAndBack(rest), strip);
    return strip;
  }

  PictureStrip Of(const NamedRun& named, const EstimateReader& estimate) {
    PictureStrip strip;
    const std::size_t slash = named.name.find('/');  // "method/variant"
    strip.label = named.name.substr(slash + 1);
    if (slash != std::string::npos) strip.sublabel = named.name.substr(0, slash);
    strip.note = NoteOf(*named.run);
    const std::vector<Color> colors = FrontAndBack(estimate.rest_mesh());
    for (const Shown& shown : frames_) {
      Paint(shown, estimate.ReadVertices(shown.frame), estimate.rest_mesh(), colors, strip);
    }
    return strip;
  }

 private:
  struct Shown {
    int frame = 0;
    std::vector<Vector3f> truth;
    PictureWindow part;
  };

  void Paint(const Shown& shown, const std::vector<Vector3f>& vertices, const TriangleMesh& rest,
             const std::vector<Color>& colors, PictureStrip& strip) {
    strip.pictures.emplace_back(
        OnWhite(view_.Draw(camera_, shown.part, {{&vertices, &rest.triangles, colors}})));
  }

  const SequenceReader& sequence_;
  MeshView& view_;
  PinholeCamera camera_;
  std::vector<Shown> frames_;
  DepthRange range_;
};

// Variants can change a scene: only the folder's name tells its sequences apart.
std::string IdOf(const RunsOfSequence& runs) {
  return "side-by-side-" + runs.front().run->sequence_folder.filename().string();
}

RunPictures Painted(const ReportedExperiment& experiment, const RunsOfSequence& runs,
                    MeshView& view) {
  const RunRecord& first = *runs.front().run;
  RunPictures pictures;
  pictures.run_id = IdOf(runs);
  try {
    const SequenceReader sequence((experiment.folder / first.sequence_folder).lexically_normal());
    if (!sequence.info().surface) {
      pictures.problem = "the sequence has no true surface to stand beside";
      return pictures;
    }
    RowPainter painter(sequence, experiment.record.picture_frames, view);
    if (painter.empty()) {
      pictures.problem = "the sequence has none of the experiment's picture frames";
      return pictures;
    }
    pictures.titles = painter.Titles();
    pictures.keys = {{kFrontColor, "skin that looks to the front in the rest pose"},
                     {kBackColor, "skin that looks to the back"}};
    pictures.nearest_m = painter.range().nearest_m();
    pictures.farthest_m = painter.range().farthest_m();
    pictures.strips = {painter.Depth(), painter.Truth()};
    for (const NamedRun& named : runs) {
      const EstimateReader estimate(experiment.folder / named.run->run_id / "estimate");
      pictures.strips.push_back(painter.Of(named, estimate));
    }
  } catch (const DataError& error) {  // the report is written without them and states the reason
    pictures.strips.clear();
    pictures.problem = error.what();
  }
  return pictures;
}

}  // namespace

std::vector<RunPictures> MakeSideBySide(const ReportedExperiment& experiment,
                                        const DrawnBefore& before, const PictureUse& use) {
  if (!experiment.record.side_by_side) return {};
  const std::vector<RunsOfSequence> groups = GroupedBySequence(experiment);
  std::vector<RunPictures> all(groups.size());
  WorkerTeam team(GetMachineInfo().threads);
  team.For(static_cast<int>(groups.size()), 1, [&](int begin, int end) {
    MeshView view(kPictureSize, kPictureSize);
    for (int i = begin; i < end; ++i) {
      if (const RunPictures* drawn = before.Pictures(IdOf(groups[i]))) {
        all[i] = *drawn;
        continue;
      }
      all[i] = Painted(experiment, groups[i], view);
      if (use) use(all[i]);
    }
  });
  return all;
}

}  // namespace vitruvia
