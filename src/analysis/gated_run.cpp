#include "analysis/gated_run.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "config/build_cache.h"
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

std::map<std::string, std::vector<double>> TimesOfAll(std::span<const RunRecord> repeats) {
  std::map<std::string, std::vector<double>> times_ms;
  for (const RunRecord& run : repeats) {
    for (const auto& [name, ms] : TimesOf(run)) times_ms[name].push_back(ms);
  }
  std::erase_if(times_ms, [&](const auto& timed) { return timed.second.size() != repeats.size(); });
  return times_ms;
}

// Dotted keys of all values that are no objects.
void Flatten(const nlohmann::json& json, const std::string& key,
             std::map<std::string, std::string>& settings) {
  if (!json.is_object()) {
    settings[key] = json.dump();
    return;
  }
  for (const auto& item : json.items())
    Flatten(item.value(), key.empty() ? item.key() : key + "." + item.key(), settings);
}

// Absolute paths shortened to the names of their files: machines keep the same file in different
// folders.
nlohmann::json WithoutFolders(nlohmann::json config) {
  if (config.is_structured()) {
    for (nlohmann::json& value : config) value = WithoutFolders(std::move(value));
  } else if (config.is_string()) {
    const std::filesystem::path path = config.get<std::string>();
    if (path.is_absolute()) config = path.filename().string();
  }
  return config;
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
  gated.times_ms = TimesOfAll(repeats);
  if (!first.config.is_object()) return gated;
  const nlohmann::json config = WithoutFolders(first.config);
  gated.config_hash = SettingsHash(config);
  Flatten(config, "", gated.settings);
  return gated;
}

std::vector<std::string> ChangedSettings(const GatedRun& was, const GatedRun& is) {
  if (was.config_hash == is.config_hash) return {};
  if (was.settings.empty()) return {"the baseline does not hold its settings; renew it"};
  constexpr const char* kNoSetting = "none";
  const auto value_in = [](const GatedRun& run, const std::string& key) {
    const auto found = run.settings.find(key);
    return found == run.settings.end() ? std::string(kNoSetting) : found->second;
  };
  std::map<std::string, std::string> all = was.settings;
  all.insert(is.settings.begin(), is.settings.end());
  std::vector<std::string> changed;
  for (const auto& [key, value] : all) {
    const std::string before = value_in(was, key), now = value_in(is, key);
    if (before != now) changed.push_back(fmt::format("{}: {} → {}", key, before, now));
  }
  return changed;
}

const GatedRun* FindRun(const std::vector<GatedRun>& runs, const std::string& name) {
  const auto found = std::find_if(runs.begin(), runs.end(),
                                  [&](const GatedRun& run) { return run.name() == name; });
  return found == runs.end() ? nullptr : &*found;
}

void GatedRun::Describe(Fields& f) {
  f.Text("experiment", experiment, {.meaning = "name of the experiment"});
  f.Text("variant", variant, {.meaning = "name of the variant"});
  f.Text("scene", scene, {.meaning = "name of the scene"});
  f.Text("method", method, {.meaning = "name of the method"});
  f.Integer("seed", seed, {.meaning = "seed of all random streams of the run"});
  f.Integer("repeats", repeats, {.meaning = "number of repeats of the run"});
  f.Map("accuracy", accuracy, {.meaning = "metric → its value in the first repeat"});
  f.Texts("unsteady", unsteady, {.meaning = "metrics that differ between the repeats"});
  f.Map("times_ms", times_ms,
        {.meaning = "name of a time → its median per frame in each repeat; comparable only with "
                    "times of the same session",
         .unit = "ms",
         .optional = true});
  f.Text("config_hash", config_hash,
         {.meaning = "hash of the run's resolved settings", .optional = true});
  f.Map("settings", settings,
        {.meaning = "dotted key of a setting → its value as JSON; in baselines only",
         .optional = true});
}

}  // namespace vitruvia
