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

nlohmann::json ToJson(const GatedRun& run) {
  return {{"experiment", run.experiment},
          {"variant", run.variant},
          {"scene", run.scene},
          {"method", run.method},
          {"seed", run.seed},
          {"repeats", run.repeats},
          {"accuracy", run.accuracy},
          {"unsteady", run.unsteady},
          {"speed", run.speed},
          {"speed_noise", run.speed_noise},
          {"calibration_ms", run.calibration_ms}};
}

GatedRun ParseGatedRun(const JsonNode& node) {
  const auto number = [](const JsonNode& item) { return item.Number(); };
  GatedRun run;
  run.experiment = node.At("experiment").Text();
  run.variant = node.At("variant").Text();
  run.scene = node.At("scene").Text();
  run.method = node.At("method").Text();
  run.seed = node.At("seed").Integer();
  run.repeats = node.At("repeats").Integer();
  run.accuracy = node.At("accuracy").Map(number);
  run.unsteady = node.At("unsteady").Texts();
  run.speed = node.At("speed").Map(number);
  run.speed_noise = node.At("speed_noise").Map(number);
  run.calibration_ms = node.At("calibration_ms").Number();
  return run;
}

}  // namespace vitruvia
