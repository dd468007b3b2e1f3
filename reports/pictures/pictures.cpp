#include "reports/pictures/pictures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <numbers>

#include <fmt/format.h>

#include "core/build_info.h"
#include "core/progress.h"
#include "core/worker_team.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "math/statistics.h"
#include "records/bone_tree.h"
#include "records/surface_strips.h"
#include "reports/drawing/axis.h"
#include "reports/drawing/color_maps.h"
#include "reports/pictures/drawn_before.h"
#include "reports/pictures/mesh_view.h"
#include "reports/pictures/picture_source.h"
#include "reports/pictures/picture_window.h"
#include "reports/pictures/surface_pictures.h"

namespace vitruvia {
namespace {

constexpr double kSideViewTurn_deg = 60.0;  // of the second viewpoint, about the vertical
constexpr double kMargin = 1.12;            // of a picture over the body in it
constexpr double kOverlayOpacity = 0.72;    // of the reconstruction over the depth image
constexpr double kSmallestErrorScale_m = 0.01;

// Errors of the vertices in view: those of a limb out of view may be arbitrarily large and would
// dominate the colour scale.
std::vector<double> ErrorsInView(const PictureSource& source) {
  std::vector<double> errors_m;
  for (const PictureFrame& frame : source.frames()) {
    for (std::size_t i = 0; i < frame.errors_m.size(); ++i) {
      if (frame.in_view[i]) errors_m.push_back(frame.errors_m[i]);
    }
  }
  return errors_m;
}

// 0 without a true surface.
double OwnErrorScale(const PictureSource& source) {
  return source.has_truth() ? ErrorScaleEnd(ErrorsInView(source), kSmallestErrorScale_m) : 0.0;
}

// The median of the runs' scales, so that a diverged run does not make the others pale.
double CommonErrorScale(const std::vector<RunPictures>& runs) {
  std::vector<double> ends_m;
  for (const RunPictures& run : runs) {
    if (run.own_error_scale_m > 0.0) ends_m.push_back(run.own_error_scale_m);
  }
  if (ends_m.empty()) return kSmallestErrorScale_m;
  return RoundedUp(Quantile(ends_m, 0.5));
}

// Turns the body about the camera's vertical through its middle, which shows it as a camera would
// that walked round it.
std::vector<Vector3f> Turned(const std::vector<Vector3f>& points, const Vector3f& middle) {
  const auto angle = static_cast<float>(kSideViewTurn_deg * std::numbers::pi / 180.0);
  const Rigidf turn = RotationAbout<float>(ExpSo3<float>({0.0f, angle, 0.0f}), middle);
  std::vector<Vector3f> turned;
  turned.reserve(points.size());
  for (const Vector3f& point : points) turned.push_back(turn * point);
  return turned;
}

ColorImage Over(const ColorImage& front, ColorImage back, double opacity) {
  for (std::size_t i = 0; i < back.pixels().size(); ++i) {
    const ColorPixel& f = front.pixels()[i];
    ColorPixel& b = back.pixels()[i];
    const double a = opacity * f[3] / 255.0;
    for (int c = 0; c < 3; ++c) {
      b[c] = static_cast<std::uint8_t>(std::lround(a * f[c] + (1.0 - a) * b[c]));
    }
  }
  return back;
}

std::vector<Color> ErrorColors(const std::vector<double>& errors_m, double scale_m) {
  std::vector<Color> colors;
  colors.reserve(errors_m.size());
  for (const double error_m : errors_m) colors.push_back(ErrorColor(error_m / scale_m));
  return colors;
}

// What every strip of a run shows round the body's middle, so that its pictures have one scale
// however far away the body is.
struct Framing {
  double front_m = 0.0, side_m = 0.0;  // width and height
};

// Draws a run's strips.
class StripPainter {
 public:
  StripPainter(const PictureSource& source, MeshView& view, RunPictures& run)
      : source_(source), view_(view), run_(run), camera_(source.sequence().info().camera) {
    FindFraming();
    DepthRange range;
    for (const PictureFrame& frame : source_.frames()) {
      range.Include(source_.sequence().ReadDepth(frame.number));
    }
    run_.nearest_m = range.nearest_m();
    run_.farthest_m = range.farthest_m();
  }

  PictureStrip Paint(const PictureFrame& frame) {
    const FrameEstimate& tracked =
        source_.estimate().frames()[static_cast<std::size_t>(frame.number)];
    PictureStrip strip;
    strip.frame = frame.number;
    strip.label = fmt::format("frame {}", frame.number);
    strip.sublabel = fmt::format("{:.2f} s", frame.number / source_.sequence().info().fps);
    for (const double error_m : frame.errors_m) {
      strip.error_mean_m += error_m / static_cast<double>(frame.errors_m.size());
      strip.error_max_m = std::max(strip.error_max_m, error_m);
    }
    strip.note = fmt::format(
        "{}{}{} · {}", Name(tracked.outcome), tracked.message.empty() ? "" : ": ", tracked.message,
        source_.has_truth() ? fmt::format("mean error {:.1f} mm, maximum {:.1f} mm",
                                          1e3 * strip.error_mean_m, 1e3 * strip.error_max_m)
                            : "no true surface");
    if (source_.has_truth()) {
      PaintWithTruth(frame, strip.pictures);
    } else {
      PaintAlone(frame, strip.pictures);
    }
    return strip;
  }

 private:
  void PaintWithTruth(const PictureFrame& frame, std::vector<Picture>& pictures) {
    const auto truth = source_.sequence().ReadTrueVertices(frame.number);
    const auto estimate = source_.estimate().ReadVertices(frame.number);
    const Vector3f middle = Middle(truth);
    const auto truth_side = Turned(truth, middle), estimate_side = Turned(estimate, middle);
    const PictureWindow front =
        Centered(Projected(camera_, truth), Pixels(camera_, framing_.front_m, middle));
    const PictureWindow side =
        Centered(Projected(camera_, truth_side), Pixels(camera_, framing_.side_m, middle));
    const auto& estimate_triangles = source_.estimate().rest_mesh().triangles;
    const auto& true_triangles = source_.sequence().true_rest_mesh().triangles;
    const std::vector<Color> errors = ErrorColors(frame.errors_m, run_.error_scale_m);
    const ShadedMesh shown_truth{&truth_side, &true_triangles, {kTruthColor}};
    const ShadedMesh shown_estimate{&estimate_side, &estimate_triangles, {kEstimateColor}};

    PaintDepth(frame, front, estimate, pictures);
    pictures.emplace_back(OnWhite(view_.Draw(camera_, side, {shown_estimate})));
    pictures.emplace_back(OnWhite(view_.Draw(camera_, side, {shown_truth})));
    pictures.emplace_back(OnWhite(view_.Draw(camera_, side, {shown_truth, shown_estimate})));
    pictures.emplace_back(
        OnWhite(view_.Draw(camera_, front, {{&estimate, &estimate_triangles, errors}})));
    pictures.emplace_back(
        OnWhite(view_.Draw(camera_, side, {{&estimate_side, &estimate_triangles, errors}})));
  }

  // What the sensor saw, and the reconstruction over it.
  void PaintDepth(const PictureFrame& frame, const PictureWindow& front,
                  const std::vector<Vector3f>& estimate, std::vector<Picture>& pictures) {
    const auto& triangles = source_.estimate().rest_mesh().triangles;
    const ColorImage depth = DepthPicture(source_.sequence().ReadDepth(frame.number), front,
                                          kPictureSize, run_.nearest_m, run_.farthest_m);
    const ColorImage seen = view_.Draw(camera_, front, {{&estimate, &triangles, {kEstimateColor}}});
    pictures.emplace_back(depth);
    pictures.emplace_back(Over(seen, depth, kOverlayOpacity));
  }

  void PaintAlone(const PictureFrame& frame, std::vector<Picture>& pictures) {
    const auto estimate = source_.estimate().ReadVertices(frame.number);
    const Vector3f middle = Middle(estimate);
    const auto from_side = Turned(estimate, middle);
    const auto window = [&](const std::vector<Vector3f>& points, double extent_m) {
      return Centered(Projected(camera_, points), Pixels(camera_, extent_m, middle));
    };
    PaintDepth(frame, window(estimate, framing_.front_m), estimate, pictures);
    const auto& triangles = source_.estimate().rest_mesh().triangles;
    pictures.emplace_back(OnWhite(view_.Draw(camera_, window(from_side, framing_.side_m),
                                             {{&from_side, &triangles, {kEstimateColor}}})));
  }

  void FindFraming() {
    for (const PictureFrame& frame : source_.frames()) {
      const auto body = source_.has_truth() ? source_.sequence().ReadTrueVertices(frame.number)
                                            : source_.estimate().ReadVertices(frame.number);
      const Vector3f middle = Middle(body);
      const double one_meter = Pixels(camera_, 1.0, middle) / kMargin;
      const auto widen = [&](double& extent_m, const std::vector<Vector3f>& points) {
        extent_m = std::max(extent_m, Projected(camera_, points).extent() / one_meter);
      };
      widen(framing_.front_m, body);
      widen(framing_.side_m, Turned(body, middle));
    }
  }

  const PictureSource& source_;
  MeshView& view_;
  RunPictures& run_;
  PinholeCamera camera_;
  Framing framing_;
};

// Null where there is nothing to draw, or surfaces instead of frames.
std::unique_ptr<PictureSource> OpenSource(const ReportedExperiment& experiment,
                                          const RunRecord& run, RunPictures& pictures) {
  const std::filesystem::path folder = experiment.folder / run.run_id;
  pictures.run_id = run.run_id;
  pictures.keys = {{kEstimateColor, "reconstruction"},
                   {kTruthColor, "truth; where both are drawn, the nearer shows"}};
  // Drawings of a model have neither reconstruction nor truth.
  if (HasBoneTree(folder)) pictures.keys.clear();
  if (HasSurfaceStrips(folder)) return nullptr;
  return OpenPictureSource(experiment, run, pictures.problem);
}

// `source`: null of a run that left surfaces.
void DrawRun(const std::filesystem::path& run_folder, const PictureSource* source,
             double error_scale_m, RunPictures& run) {
  MeshView view(kPictureSize, kPictureSize);
  if (source == nullptr) return DrawSurfaceStrips(run_folder, view, run);
  run.titles = source->has_truth() ? PictureTitles() : PictureTitlesWithoutTruth();
  if (source->has_truth()) {
    run.error_scale_m = error_scale_m;
  } else {
    run.keys = {{kEstimateColor, "reconstruction"}};
  }
  StripPainter painter(*source, view, run);
  for (const PictureFrame& frame : source->frames()) run.strips.push_back(painter.Paint(frame));
}

}  // namespace

const std::vector<std::string>& PictureTitles() {
  static const std::string turned = fmt::format(", from {:g}° to the side", kSideViewTurn_deg);
  static const std::vector<std::string> titles = {"depth",
                                                  "reconstruction over depth",
                                                  "reconstruction" + turned,
                                                  "truth" + turned,
                                                  "both" + turned,
                                                  "error",
                                                  "error" + turned};
  return titles;
}

std::vector<std::string> PictureTitlesWithoutTruth() {
  return {PictureTitles().begin(), PictureTitles().begin() + 3};
}

std::vector<RunPictures> MakePictures(const ReportedExperiment& experiment,
                                      const DrawnBefore& before, const PictureUse& use) {
  const std::vector<const RunRecord*> runs = experiment.finished();
  std::vector<RunPictures> all(runs.size());
  std::vector<std::unique_ptr<PictureSource>> sources(runs.size());
  WorkerTeam team(GetMachineInfo().threads);
  const auto for_each_run = [&](const auto& work) {
    team.For(static_cast<int>(runs.size()), 1, [&](int begin, int end) {
      for (int r = begin; r < end; ++r) work(static_cast<std::size_t>(r));
    });
  };
  const auto open = [&](std::size_t r) {
    all[r] = {};
    sources[r] = OpenSource(experiment, *runs[r], all[r]);
    if (sources[r] != nullptr) all[r].own_error_scale_m = OwnErrorScale(*sources[r]);
  };
  std::vector<bool> to_draw(runs.size());
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const RunPictures* drawn = before.Pictures(runs[r]->run_id);
    to_draw[r] = drawn == nullptr;
    if (drawn != nullptr) all[r] = *drawn;
  }
  for_each_run([&](std::size_t r) {
    if (to_draw[r]) open(r);
  });
  const double error_scale_m = CommonErrorScale(all);
  Progress progress("pictures", static_cast<int>(runs.size()));
  std::mutex progress_mutex;
  for_each_run([&](std::size_t r) {
    ThrowIfInterrupted();
    const bool has_other_colors =
        !to_draw[r] && all[r].own_error_scale_m > 0.0 && all[r].error_scale_m != error_scale_m;
    if (has_other_colors) open(r);
    if (to_draw[r] || has_other_colors) {
      if (all[r].problem.empty())
        DrawRun(experiment.folder / all[r].run_id, sources[r].get(), error_scale_m, all[r]);
      sources[r].reset();
      if (use) use(all[r]);
    }
    const std::lock_guard lock(progress_mutex);
    progress.Advance();
  });
  return all;
}

}  // namespace vitruvia
