#include "analysis/gated_run.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "math/statistics.h"
#include "records/metric_value.h"

namespace vitruvia {
namespace {

std::map<std::string, double> TimesOf(const RunRecord& run) {
  std::map<std::string, double> times_ms;
  for (const WholeTime& timed : kWholeTimes) {
    const double ms = MetricValue(run, timed.metric);
    if (!std::isnan(ms)) times_ms[timed.name] = ms;
  }
  for (const RunRecord::Step& step : run.steps) times_ms[step.name] = step.median_ms;
  return times_ms;
}

void MeasureSpeed(std::span<const RunRecord> repeats, GatedRun& gated) {
  std::map<std::string, std::vector<double>> ratios;
  for (const RunRecord& run : repeats) {
    const double calibration_ms = CalibrationOf(run);
    if (std::isnan(calibration_ms) || calibration_ms <= 0.0) continue;
    for (const auto& [name, ms] : TimesOf(run)) ratios[name].push_back(ms / calibration_ms);
  }
  for (const auto& [name, values] : ratios) {
    const double median = Quantile(values, 0.5);
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    gated.speed[name] = median;
    gated.speed_noise[name] = median > 0.0 ? 0.5 * (*most - *least) / median : 0.0;
  }
}

bool IsSame(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace

std::string GatedRun::name() const {
  return fmt::format("{}: {}.{}.{}.s{}", experiment, variant, scene, method, seed);
}

GatedRun MakeGatedRun(const std::string& experiment, std::span<const RunRecord> repeats) {
  Require(!repeats.empty(), "MakeGatedRun: {} has no repeat", experiment);
  const RunRecord& first = repeats.front();
  GatedRun gated;
  gated.experiment = experiment;
  gated.variant = first.variant;
  gated.scene = first.scene;
  gated.method = first.method;
  gated.seed = first.seed;
  gated.repeats = static_cast<int>(repeats.size());
  for (const Metric& metric : MetricsShownIn(Place::kGate)) {
    const double value = MetricValue(first, metric);
    if (!std::isnan(value)) gated.accuracy[metric.key] = value;
    const bool is_steady = std::all_of(
        repeats.begin(), repeats.end(),
        [&](const RunRecord& repeat) { return IsSame(MetricValue(repeat, metric), value); });
    if (!is_steady) gated.unsteady.push_back(metric.key);
  }
  MeasureSpeed(repeats, gated);
  std::vector<double> calibrations_ms;
  for (const RunRecord& repeat : repeats) {
    if (!std::isnan(CalibrationOf(repeat))) calibrations_ms.push_back(CalibrationOf(repeat));
  }
  if (!calibrations_ms.empty()) gated.calibration_ms = Quantile(calibrations_ms, 0.5);
  return gated;
}

void GatedRun::Describe(Fields& f) {
  f.Text("experiment", experiment, {.meaning = "name of the experiment"});
  f.Text("variant", variant, {.meaning = "name of the variant"});
  f.Text("scene", scene, {.meaning = "name of the scene"});
  f.Text("method", method, {.meaning = "name of the method"});
  f.Integer("seed", seed, {.meaning = "seed of all random streams of the run"});
  f.Integer("repeats", repeats, {.meaning = "how often the run was repeated"});
  f.Map("accuracy", accuracy, {.meaning = "metric → its value in the first repeat"});
  f.Texts("unsteady", unsteady, {.meaning = "metrics that differ between the repeats"});
  f.Map("speed", speed,
        {.meaning = "what was timed → its time as a multiple of the calibration kernel's, the "
                    "median over the repeats"});
  f.Map("speed_noise", speed_noise,
        {.meaning = "what was timed → half the range of its time over the repeats as a share of "
                    "the median"});
  f.Number(
      "calibration_ms", calibration_ms,
      {.meaning = "time of the calibration kernel, the median over the repeats", .unit = "ms"});
}

}  // namespace vitruvia
