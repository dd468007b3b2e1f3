#include "reports/figures/contender_plots.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "analysis/printed_metric.h"
#include "analysis/variant_comparison.h"
#include "math/statistics.h"
#include "records/metric_value.h"
#include "reports/drawing/color_maps.h"
#include "reports/figures/figure_parts.h"

namespace vitruvia {
namespace {

constexpr const char* kHistogramMetric = "joints_within_10cm";
constexpr double kBarGap = 0.2;  // between the bars of two scenes, of a scene's width

Series NamedSeries(const std::string& name, std::size_t index) {
  Series series;
  series.name = name;
  series.color = kRunColors[index % kRunColors.size()];
  if (index >= kRunColors.size()) series.dash = kSecondRoundDash;
  return series;
}

Series AccuracyCurve(const Contender& contender, const char* joints, std::size_t index) {
  Series line = NamedSeries(contender.name, index);
  int count = 0;
  for (const RunRecord* run : contender.runs) {
    const auto curve = run->joint_accuracy.find(joints);
    if (curve == run->joint_accuracy.end()) continue;
    if (count++ == 0) {
      for (const double threshold_m : run->threshold_m) line.x.push_back(1e2 * threshold_m);
      line.y.assign(line.x.size(), 0.0);
    }
    for (std::size_t i = 0; i < std::min(line.y.size(), curve->second.size()); ++i)
      line.y[i] += 1e2 * curve->second[i];
  }
  for (double& y : line.y) y /= std::max(count, 1);
  return line;
}

Figure AccuracyOf(const std::vector<Contender>& contenders) {
  Figure figure;
  figure.name = kContenderAccuracy;
  figure.title = "Joint accuracy over all scenes";
  figure.caption =
      "Share of joints within the threshold, averaged over the runs of each contender: as they "
      "are, and after the mean offset of each joint over a run is taken off.";
  figure.columns = 2;
  for (const auto& [joints, title] : {std::pair{"all", "as they are"},
                                      std::pair{"less_offset", "less each joint’s mean offset"}}) {
    Panel panel{title, "threshold (cm)", "joints within threshold (%)", {}, {}, {}};
    panel.y_end = 100.0;
    for (std::size_t c = 0; c < contenders.size(); ++c) {
      Series line = AccuracyCurve(contenders[c], joints, c);
      if (line.x.empty()) continue;
      panel.x_end = line.x.back();
      panel.series.push_back(std::move(line));
    }
    if (!panel.series.empty()) figure.panels.push_back(std::move(panel));
  }
  return figure;
}

double MeanInScene(const Contender& contender, const std::string& scene, const Metric& metric) {
  std::vector<double> values;
  for (const RunRecord* run : contender.runs) {
    if (run->scene == scene && !std::isnan(MetricValue(*run, metric)))
      values.push_back(metric.scale * MetricValue(*run, metric));
  }
  return values.empty() ? NAN : Mean(values);
}

// The outlines of one contender's bars: bar `index` of `count` round each scene's number.
Series BarsOf(const Contender& contender, const std::vector<std::string>& scenes,
              const Metric& metric, std::size_t index, std::size_t count) {
  Series bars = NamedSeries(contender.name, index);
  const double width = (1.0 - kBarGap) / static_cast<double>(count);
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    const double height = MeanInScene(contender, scenes[s], metric);
    if (std::isnan(height)) continue;
    const double left =
        static_cast<double>(s) - 0.5 * (1.0 - kBarGap) + width * static_cast<double>(index);
    const double right = left + 0.9 * width;
    bars.x.insert(bars.x.end(), {left, left, right, right, right});
    bars.y.insert(bars.y.end(), {0.0, height, height, 0.0, NAN});
  }
  return bars;
}

Figure Histogram(const std::vector<Contender>& contenders, const std::vector<std::string>& scenes) {
  const Metric metric = FindMetric(kHistogramMetric);
  Figure figure;
  figure.name = kJointsByScene;
  figure.title = "Joints within 10 cm, scene by scene";
  figure.caption = "One bar for each contender, the mean over its runs of the scene.";
  Panel panel{"", "scene", Titled(metric), {}, {}, {}};
  for (std::size_t s = 0; s < scenes.size(); ++s)
    panel.x_ticks.push_back({static_cast<double>(s), scenes[s]});
  panel.y_end = 100.0;
  for (std::size_t c = 0; c < contenders.size(); ++c)
    panel.series.push_back(BarsOf(contenders[c], scenes, metric, c, contenders.size()));
  figure.panels = {std::move(panel)};
  return figure;
}

}  // namespace

std::vector<Figure> MakeContenderPlots(const ReportedExperiment& experiment) {
  const std::vector<const RunRecord*> runs = experiment.finished();
  const bool has_joints = std::any_of(
      runs.begin(), runs.end(), [](const RunRecord* run) { return !run->joint_accuracy.empty(); });
  if (!has_joints) return {};
  const std::vector<Contender> contenders = ContendersOf(experiment);
  return {AccuracyOf(contenders), Histogram(contenders, ScenesOf(runs))};
}

}  // namespace vitruvia
