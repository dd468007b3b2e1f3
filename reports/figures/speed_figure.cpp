#include "reports/figures/speed_figure.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "analysis/pareto_front.h"
#include "analysis/printed_metric.h"
#include "analysis/variant_comparison.h"
#include "math/statistics.h"
#include "records/metric_value.h"
#include "reports/drawing/color_maps.h"
#include "reports/figures/figure_parts.h"
#include "reports/figures/run_plots.h"

namespace vitruvia {
Metric ErrorMetricOf(const ReportedExperiment& experiment) {
  const std::vector<const RunRecord*> runs = experiment.finished();
  const std::vector<Metric> metrics = MetricsShownIn(Place::kSpeedPlot);
  for (const Metric& metric : metrics) {
    const bool is_there = std::any_of(runs.begin(), runs.end(), [&](const RunRecord* run) {
      return !std::isnan(MetricValue(*run, metric));
    });
    if (is_there) return metric;
  }
  return metrics.front();
}

namespace {

constexpr Color kFrontInk{0x55, 0x55, 0x55};
constexpr double kFrontDash = 4.0;

struct SpeedPoint {
  std::string name;
  double median_ms = 0.0, p95_ms = 0.0, error = 0.0;
  bool on_front = false;
};

// Over the contender's runs of a scene; "": of all scenes. The error is in the metric's unit.
SpeedPoint PointOf(const Contender& contender, const std::string& scene,
                   const Metric& error_metric) {
  std::vector<double> frame_ms, errors;
  for (const RunRecord* run : contender.runs) {
    const auto found = run->frames.find("frame_ms");
    if (found == run->frames.end() || (!scene.empty() && run->scene != scene)) continue;
    frame_ms.insert(frame_ms.end(), found->second.begin(), found->second.end());
    errors.push_back(MetricValue(*run, error_metric));
  }
  if (frame_ms.empty()) return {contender.name, NAN, NAN, NAN};
  return {contender.name, Quantile(frame_ms, 0.5), Quantile(frame_ms, 0.95),
          error_metric.scale * Mean(errors)};
}

std::vector<SpeedPoint> PointsOf(const ReportedExperiment& experiment, const std::string& scene,
                                 const Metric& error_metric) {
  std::vector<SpeedPoint> points;
  std::vector<Costs> costs;
  for (const Contender& contender : ContendersOf(experiment)) {
    const SpeedPoint point = PointOf(contender, scene, error_metric);
    if (std::isnan(point.median_ms) || std::isnan(point.error)) continue;
    points.push_back(point);
    costs.push_back({point.median_ms, point.error});
  }
  const std::vector<bool> front = ParetoFront(costs);
  for (std::size_t i = 0; i < points.size(); ++i) points[i].on_front = front[i];
  return points;
}

// A step line through the points of the front: the least error for each time.
Series FrontLine(std::vector<SpeedPoint> points) {
  std::erase_if(points, [](const SpeedPoint& point) { return !point.on_front; });
  std::sort(points.begin(), points.end(),
            [](const SpeedPoint& a, const SpeedPoint& b) { return a.median_ms < b.median_ms; });
  Series line;
  line.name = "front";
  line.color = kFrontInk;
  line.dash = kFrontDash;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0) {
      line.x.push_back(points[i].median_ms);
      line.y.push_back(points[i - 1].error);
    }
    line.x.push_back(points[i].median_ms);
    line.y.push_back(points[i].error);
  }
  return line;
}

Series Drawn(const SpeedPoint& point, std::size_t index, bool numbered) {
  Series series;
  series.name = numbered ? fmt::format("{} {}", index + 1, point.name) : point.name;
  series.runs_of = point.name;
  series.color = VariantColor(index);
  series.mark = point.on_front ? Mark::kPoints : Mark::kRings;
  series.x = {point.median_ms};
  series.x_reach = {point.p95_ms};
  series.y = {point.error};
  if (numbered) series.label = fmt::format("{}", index + 1);
  return series;
}

std::string CalibrationText(const ReportedExperiment& experiment) {
  std::vector<double> ms;
  for (const RunRecord* run : experiment.finished()) {
    if (!std::isnan(CalibrationOf(*run))) ms.push_back(CalibrationOf(*run));
  }
  if (ms.empty()) return "";
  return fmt::format(
      " The calibration kernel took {:.2f} ms beside these runs (median): times of another machine "
      "compare as multiples of its own.",
      Quantile(ms, 0.5));
}

// The scenes with separate panels, because times of different cameras and bodies are not
// comparable; for one scene or many scenes a single panel: "".
std::vector<std::string> PanelScenes(const ReportedExperiment& experiment) {
  constexpr std::size_t kMostPanels = 4;
  std::vector<std::string> scenes;
  for (const RunRecord* run : experiment.finished()) {
    const bool is_new = std::find(scenes.begin(), scenes.end(), run->scene) == scenes.end();
    if (is_new) scenes.push_back(run->scene);
  }
  return scenes.size() > 1 && scenes.size() <= kMostPanels ? scenes : std::vector<std::string>{""};
}

Panel SpeedPanel(const ReportedExperiment& experiment, const std::string& scene,
                 const Metric& error_metric) {
  Panel panel{scene,
              "time per frame (ms)" + ThreadsText(experiment.finished()),
              Titled(error_metric),
              {},
              PublishedReferences(experiment.record, error_metric),
              PublishedReferences(experiment.record, FindMetric("frame_ms_median"))};
  const std::vector<SpeedPoint> points = PointsOf(experiment, scene, error_metric);
  std::vector<double> times_ms, errors;
  for (const SpeedPoint& point : points) {
    times_ms.insert(times_ms.end(), {point.median_ms, point.p95_ms});
    errors.push_back(point.error);
  }
  panel.x_scale = ScaleFor(times_ms);
  panel.y_scale = ScaleFor(errors);
  const Series front = FrontLine(points);
  if (front.x.size() > 1) panel.series.push_back(front);
  for (std::size_t i = 0; i < points.size(); ++i)
    panel.series.push_back(Drawn(points[i], i, points.size() > kRunColors.size()));
  return panel;
}

}  // namespace

std::vector<Reference> PublishedReferences(const ExperimentRecord& experiment,
                                           const Metric& metric) {
  std::vector<Reference> references;
  for (const Expectation& e : experiment.expectations) {
    if (e.metric != metric.key || std::isnan(e.paper)) continue;
    const double published = e.paper * metric.scale;
    references.push_back(
        {fmt::format("{}: {:g}{}{}{}", e.source, published, metric.unit.empty() ? "" : " ",
                     metric.unit, e.not_comparable.empty() ? "" : ", not comparable"),
         published, e.not_comparable.empty()});
  }
  return references;
}

Figure MakeSpeedFigure(const ReportedExperiment& experiment) {
  const Metric error_metric = ErrorMetricOf(experiment);
  const std::vector<std::string> scenes = PanelScenes(experiment);
  Figure figure;
  figure.name = kSpeedFigure;
  figure.title = "Speed against error";
  figure.caption =
      fmt::format(
          "One point for each variant, over {}: the median time per frame, with a bar to the 95th "
          "percentile, and the mean error over all frames, failed ones included. Down and to the "
          "left is better: discs are the variants that no other beats in both, the dashed line is "
          "what can be had at each price, rings are beaten.",
          scenes.size() > 1 ? "the seeds of a scene" : "all its scenes and seeds") +
      CalibrationText(experiment);
  for (const std::string& scene : scenes) {
    figure.panels.push_back(SpeedPanel(experiment, scene, error_metric));
  }
  figure.columns = 2;
  for (const Contender& contender : ContendersOf(experiment))
    AddRuns(contender.name, contender.runs, figure);
  return figure;
}

}  // namespace vitruvia
