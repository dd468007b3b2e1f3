#include "reports/figures/run_plots.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "analysis/printed_metric.h"
#include "core/error.h"
#include "reports/drawing/color_maps.h"
#include "reports/figures/speed_figure.h"

namespace vitruvia {
namespace {

using Runs = std::vector<const RunRecord*>;

constexpr const char* kFrameAxis = "frame (number)";

// Runs that share a plot: of one scene, as many as there are colours.
struct RunGroup {
  std::string suffix;  // of file names and titles; "" where all runs are in one group
  Runs runs;
};

std::string FileSafe(std::string text) {
  for (char& c : text) {
    const bool safe = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
    if (!safe) c = '-';
  }
  return text;
}

std::vector<RunGroup> Grouped(const Runs& runs) {
  std::vector<RunGroup> groups;
  std::map<std::string, std::size_t> open;  // scene → its group that is not full
  std::map<std::string, int> count;
  for (const RunRecord* run : runs) {
    const auto found = open.find(run->scene);
    if (found == open.end() || groups[found->second].runs.size() == kRunColors.size()) {
      const int number = ++count[run->scene];
      open[run->scene] = groups.size();
      groups.push_back({number == 1 ? run->scene : fmt::format("{} {}", run->scene, number), {}});
    }
    groups[open[run->scene]].runs.push_back(run);
  }
  if (groups.size() == 1) groups.front().suffix.clear();
  return groups;
}

const std::vector<double>& SeriesOf(const RunRecord& run, const std::string& key) {
  const auto found = run.frames.find(key);
  if (found == run.frames.end()) {
    throw DataError(fmt::format("run {}: record.json: frames.{}: key missing", run.run_id, key));
  }
  return found->second;
}

double One(const RunRecord& /*run*/) { return 1.0; }
double Diagonal(const RunRecord& run) { return run.diagonal_m; }

// A series of the records, divided by the run's own unit length, in the unit of a metric.
struct PlottedSeries {
  std::string key;  // of the series
  Metric metric;    // what the plot shows, and papers publish
  double (*unit_of)(const RunRecord&) = One;
};

// One line per run over the frames' numbers; crosses where frames failed.
std::vector<Series> LinesPerFrame(const Runs& runs, const PlottedSeries& plotted) {
  std::vector<Series> lines;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    Series line;
    line.name = runs[r]->run_id;
    line.color = kRunColors[r];
    const std::vector<double>& values = SeriesOf(*runs[r], plotted.key);
    const std::vector<double>& failed = SeriesOf(*runs[r], "failed");
    const double unit = plotted.unit_of(*runs[r]);
    for (std::size_t i = 0; i < values.size(); ++i) {
      line.x.push_back(static_cast<double>(i));
      line.y.push_back(plotted.metric.scale * (values[i] / unit));
      if (failed[i] != 0.0) line.failed_x.push_back(static_cast<double>(i));
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

bool HasSurfaceErrors(const RunRecord& run) { return run.frames.contains("l2_mean_m"); }
bool HasJointErrors(const RunRecord& run) { return !run.joint_accuracy.empty(); }
bool HasOnlyJointErrors(const RunRecord& run) {
  return HasJointErrors(run) && !HasSurfaceErrors(run);
}

double LastFrame(const Runs& runs) {
  std::size_t frames = 2;
  for (const RunRecord* run : runs) frames = std::max(frames, SeriesOf(*run, "failed").size());
  return static_cast<double>(frames - 1);
}

Panel PanelPerFrame(const std::string& title, const PlottedSeries& plotted,
                    const ExperimentRecord& experiment, const Runs& runs) {
  Panel panel{title,
              kFrameAxis,
              Titled(plotted.metric),
              LinesPerFrame(runs, plotted),
              PublishedReferences(experiment, plotted.metric),
              {}};
  panel.x_end = LastFrame(runs);
  return panel;
}

Figure ErrorFigure(const ExperimentRecord& experiment, const RunGroup& group) {
  Figure figure;
  figure.name = "error-per-frame";
  figure.title = "Error per frame";
  figure.caption =
      "Mean and maximum distance between corresponding points of the estimated and the true "
      "surface, as a fraction of the diagonal of the subject's rest-pose bounding box.";
  figure.panels = {PanelPerFrame("mean over the surface",
                                 {"l2_mean_m", FindMetric("l2_mean_of_diagonal"), Diagonal},
                                 experiment, group.runs),
                   PanelPerFrame("maximum over the surface",
                                 {"l2_max_m", FindMetric("l2_max_of_diagonal"), Diagonal},
                                 experiment, group.runs)};
  return figure;
}

Figure JointErrorFigure(const ExperimentRecord& experiment, const RunGroup& group) {
  Figure figure;
  figure.name = "joint-error-per-frame";
  figure.title = "Joint error per frame";
  figure.caption =
      "Mean and maximum distance between estimated and true joints. The sequence has no true "
      "surface.";
  for (const auto& [title, key] : {std::pair{"mean over the joints", "joint_error_mean_m"},
                                   std::pair{"maximum over the joints", "joint_error_max_m"}}) {
    figure.panels.push_back(PanelPerFrame(title, {key, FindMetric(key)}, experiment, group.runs));
  }
  return figure;
}

Figure TimeFigure(const ExperimentRecord& experiment, const RunGroup& group) {
  Figure figure;
  figure.name = "time-per-frame";
  figure.title = "Time per frame";
  figure.caption = "Wall clock round the tracker's step only, without reading, writing or scoring.";
  Panel panel = PanelPerFrame("", {"frame_ms", FindMetric("frame_ms")}, experiment, group.runs);
  panel.y_references = PublishedReferences(experiment, FindMetric("frame_ms_median"));
  panel.y_scale = Scale::kLogarithmic;  // a first frame may take ten times as long as the others
  figure.panels = {std::move(panel)};
  return figure;
}

Figure AccuracyFigure(const ExperimentRecord& /*experiment*/, const RunGroup& group) {
  Figure figure;
  figure.name = "joint-accuracy";
  figure.title = "Joint accuracy";
  figure.caption =
      "Share of joints, over all frames, whose estimate lies within the threshold of the truth: "
      "all joints, those that the camera sees, and those that are hidden from it.";
  figure.columns = 3;
  for (const std::string joints : {"all", "visible", "hidden"}) {
    Panel panel{joints + " joints", "threshold (cm)", "joints within threshold (%)", {}, {}, {}};
    panel.y_end = 100.0;
    for (std::size_t r = 0; r < group.runs.size(); ++r) {
      const RunRecord& run = *group.runs[r];
      Series line;
      line.name = run.run_id;
      line.color = kRunColors[r];
      const auto found = run.joint_accuracy.find(joints);
      if (found == run.joint_accuracy.end()) continue;
      for (std::size_t i = 0; i < run.threshold_m.size(); ++i) {
        line.x.push_back(1e2 * run.threshold_m[i]);
        line.y.push_back(1e2 * found->second[i]);
      }
      if (!run.threshold_m.empty()) panel.x_end = 1e2 * run.threshold_m.back();
      panel.series.push_back(std::move(line));
    }
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace

std::vector<Figure> MakeFigures(const ReportedExperiment& experiment) {
  std::vector<Figure> figures;
  Runs runs = experiment.finished();  // those with frames
  std::erase_if(runs, [](const RunRecord* run) { return run->frames.empty(); });
  const std::vector<RunGroup> groups = Grouped(runs);
  if (groups.empty()) return figures;
  // Of the runs that measured what the figure shows.
  const auto add_for_each_group = [&](Figure (*make)(const ExperimentRecord&, const RunGroup&),
                                      bool (*has)(const RunRecord&)) {
    for (RunGroup group : groups) {
      std::erase_if(group.runs, [has](const RunRecord* run) { return !has(*run); });
      if (group.runs.empty()) continue;
      Figure figure = make(experiment.record, group);
      if (!group.suffix.empty()) {
        figure.name = fmt::format("{}-{}", figure.name, FileSafe(group.suffix));
        figure.title += ": " + group.suffix;
      }
      figures.push_back(std::move(figure));
    }
  };
  add_for_each_group(ErrorFigure, HasSurfaceErrors);
  add_for_each_group(JointErrorFigure, HasOnlyJointErrors);
  figures.push_back(MakeSpeedFigure(experiment));
  add_for_each_group(AccuracyFigure, HasJointErrors);
  add_for_each_group(TimeFigure, [](const RunRecord&) { return true; });
  return figures;
}

}  // namespace vitruvia
