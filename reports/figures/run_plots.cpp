#include "reports/figures/run_plots.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <fmt/format.h>

#include "analysis/printed_metric.h"
#include "analysis/variant_comparison.h"
#include "core/error.h"
#include "reports/drawing/color_maps.h"
#include "reports/figures/figure_parts.h"
#include "reports/figures/speed_figure.h"
#include "reports/figures/step_figure.h"
#include "reports/figures/sweep_figure.h"

namespace vitruvia {
namespace {

using Runs = std::vector<const RunRecord*>;

constexpr const char* kFrameAxis = "frame (number)";

// A variant's runs of one scene.
struct VariantRuns {
  std::string name;
  Color color;
  Runs runs;
};

// Variants that share a plot: of one scene, as many as there are colours.
struct PlotGroup {
  std::string suffix;  // of file names and titles; "" where all are in one group
  std::vector<VariantRuns> variants;
};

// The runs with frames of each scene, by variant.
std::vector<PlotGroup> Grouped(const ReportedExperiment& experiment) {
  const std::vector<Contender> contenders = ContendersOf(experiment);
  std::vector<PlotGroup> groups;
  for (const std::string& scene : ScenesOf(experiment.finished())) {
    int count = 0;
    for (std::size_t c = 0; c < contenders.size(); ++c) {
      VariantRuns variant{contenders[c].name, VariantColor(c), {}};
      for (const RunRecord* run : contenders[c].runs) {
        if (run->scene == scene && !run->frames.empty()) variant.runs.push_back(run);
      }
      if (variant.runs.empty()) continue;
      if (count == 0 || groups.back().variants.size() == kRunColors.size()) {
        ++count;
        groups.push_back({count == 1 ? scene : fmt::format("{} {}", scene, count), {}});
      }
      groups.back().variants.push_back(std::move(variant));
    }
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

std::vector<double> ValuesOf(const RunRecord& run, const PlottedSeries& plotted) {
  std::vector<double> values = SeriesOf(run, plotted.key);
  const double unit = plotted.unit_of(run);
  for (double& value : values) value = plotted.metric.scale * (value / unit);
  return values;
}

std::vector<double> FailedFrames(const Runs& runs) {
  std::set<double> frames;
  for (const RunRecord* run : runs) {
    const std::vector<double>& failed = SeriesOf(*run, "failed");
    for (std::size_t i = 0; i < failed.size(); ++i) {
      if (failed[i] != 0.0) frames.insert(static_cast<double>(i));
    }
  }
  return {frames.begin(), frames.end()};
}

std::vector<double> FrameNumbers(const Runs& runs) {
  std::size_t frames = 0;
  for (const RunRecord* run : runs) frames = std::max(frames, SeriesOf(*run, "failed").size());
  std::vector<double> numbers(frames);
  std::iota(numbers.begin(), numbers.end(), 0.0);
  return numbers;
}

// One line per variant over the frames' numbers; crosses where frames of any of its runs failed.
std::vector<Series> LinesPerFrame(const PlotGroup& group, const PlottedSeries& plotted) {
  std::vector<Series> lines;
  for (const VariantRuns& variant : group.variants) {
    std::vector<std::vector<double>> curves;
    for (const RunRecord* run : variant.runs) curves.push_back(ValuesOf(*run, plotted));
    lines.push_back(MeanCurve(variant.name, variant.color, FrameNumbers(variant.runs), curves));
    lines.back().failed_x = FailedFrames(variant.runs);
  }
  return lines;
}

bool HasSurfaceErrors(const RunRecord& run) { return run.frames.contains("l2_mean_m"); }
bool HasJointErrors(const RunRecord& run) { return !run.joint_accuracy.empty(); }
bool HasOnlyJointErrors(const RunRecord& run) {
  return HasJointErrors(run) && !HasSurfaceErrors(run);
}

double LastFrame(const PlotGroup& group) {
  std::size_t frames = 2;
  for (const VariantRuns& variant : group.variants)
    frames = std::max(frames, FrameNumbers(variant.runs).size());
  return static_cast<double>(frames - 1);
}

Panel PanelPerFrame(const std::string& title, const PlottedSeries& plotted,
                    const ExperimentRecord& experiment, const PlotGroup& group) {
  Panel panel{title,
              kFrameAxis,
              Titled(plotted.metric),
              LinesPerFrame(group, plotted),
              PublishedReferences(experiment, plotted.metric),
              {}};
  panel.x_end = LastFrame(group);
  return panel;
}

Figure ErrorFigure(const ExperimentRecord& experiment, const PlotGroup& group) {
  Figure figure;
  figure.name = "error-per-frame";
  figure.title = "Error per frame";
  figure.caption =
      "Mean and maximum distance between corresponding points of the estimated and the true "
      "surface, as a fraction of the diagonal of the subject's rest-pose bounding box.";
  figure.panels = {
      PanelPerFrame("mean over the surface",
                    {"l2_mean_m", FindMetric("l2_mean_of_diagonal"), Diagonal}, experiment, group),
      PanelPerFrame("maximum over the surface",
                    {"l2_max_m", FindMetric("l2_max_of_diagonal"), Diagonal}, experiment, group)};
  return figure;
}

Figure JointErrorFigure(const ExperimentRecord& experiment, const PlotGroup& group) {
  Figure figure;
  figure.name = "joint-error-per-frame";
  figure.title = "Joint error per frame";
  figure.caption =
      "Mean and maximum distance between estimated and true joints. The sequence has no true "
      "surface.";
  for (const auto& [title, key] : {std::pair{"mean over the joints", "joint_error_mean_m"},
                                   std::pair{"maximum over the joints", "joint_error_max_m"}}) {
    figure.panels.push_back(PanelPerFrame(title, {key, FindMetric(key)}, experiment, group));
  }
  return figure;
}

Figure TimeFigure(const ExperimentRecord& experiment, const PlotGroup& group) {
  Figure figure;
  figure.name = "time-per-frame";
  figure.title = "Time per frame";
  figure.caption = "Wall clock round the tracker's step only, without reading, writing or scoring.";
  Panel panel = PanelPerFrame("", {"frame_ms", FindMetric("frame_ms")}, experiment, group);
  Runs all;
  for (const VariantRuns& variant : group.variants)
    all.insert(all.end(), variant.runs.begin(), variant.runs.end());
  panel.y_label += ThreadsText(all);
  panel.y_references = PublishedReferences(experiment, FindMetric("frame_ms_median"));
  panel.y_scale = Scale::kLogarithmic;  // a first frame may take ten times as long as the others
  figure.panels = {std::move(panel)};
  return figure;
}

std::vector<double> Scaled(std::vector<double> values) {
  constexpr double kHundred = 1e2;  // centimetres, per cent
  for (double& value : values) value *= kHundred;
  return values;
}

Figure AccuracyFigure(const ExperimentRecord& /*experiment*/, const PlotGroup& group) {
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
    for (const VariantRuns& variant : group.variants) {
      std::vector<double> thresholds_cm;
      std::vector<std::vector<double>> curves;
      for (const RunRecord* run : variant.runs) {
        const auto found = run->joint_accuracy.find(joints);
        if (found == run->joint_accuracy.end()) continue;
        if (run->threshold_m.size() > thresholds_cm.size())
          thresholds_cm = Scaled(run->threshold_m);
        curves.push_back(Scaled(found->second));
      }
      if (curves.empty() || thresholds_cm.empty()) continue;
      panel.x_end = thresholds_cm.back();
      panel.series.push_back(MeanCurve(variant.name, variant.color, thresholds_cm, curves));
    }
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace

std::vector<Figure> MakeFigures(const ReportedExperiment& experiment) {
  std::vector<Figure> figures;
  const std::vector<PlotGroup> groups = Grouped(experiment);
  if (groups.empty()) return figures;
  // Of the runs that measured what the figure shows.
  const auto add_for_each_group = [&](Figure (*make)(const ExperimentRecord&, const PlotGroup&),
                                      bool (*has)(const RunRecord&)) {
    for (PlotGroup group : groups) {
      for (VariantRuns& variant : group.variants)
        std::erase_if(variant.runs, [has](const RunRecord* run) { return !has(*run); });
      std::erase_if(group.variants, [](const VariantRuns& v) { return v.runs.empty(); });
      if (group.variants.empty()) continue;
      Figure figure = make(experiment.record, group);
      figure.caption += kBandText;
      for (const VariantRuns& variant : group.variants) AddRuns(variant.name, variant.runs, figure);
      if (!group.suffix.empty()) {
        figure.name = fmt::format("{}-{}", figure.name, FileSafe(group.suffix));
        figure.title += ": " + group.suffix;
      }
      figures.push_back(std::move(figure));
    }
  };
  for (Figure& figure : MakeSweepFigures(experiment)) figures.push_back(std::move(figure));
  add_for_each_group(ErrorFigure, HasSurfaceErrors);
  add_for_each_group(JointErrorFigure, HasOnlyJointErrors);
  figures.push_back(MakeSpeedFigure(experiment));
  add_for_each_group(AccuracyFigure, HasJointErrors);
  add_for_each_group(TimeFigure, [](const RunRecord&) { return true; });
  if (std::optional<Figure> steps = MakeStepFigure(experiment)) figures.push_back(*steps);
  return figures;
}

}  // namespace vitruvia
