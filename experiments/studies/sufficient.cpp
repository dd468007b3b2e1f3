#include "experiments/studies/sufficient.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"
#include "experiments/plan/run_plan.h"
#include "experiments/run/runner.h"
#include "math/statistics.h"
#include "records/metric_value.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kFullModel = "full";

using Parts = std::vector<VariantSettings>;

// The model without those parts.
VariantSettings Without(const Parts& parts) {
  VariantSettings model;
  model.name = kFullModel;
  for (const VariantSettings& part : parts) {
    model.name = (model.name == kFullModel ? "without_" : model.name + "+") + part.name;
    model.scene = Merged(model.scene, part.scene);
    model.method = Merged(model.method, part.method);
    if (!part.subject.empty()) model.subject = part.subject;
    if (!part.faults.AreNone()) model.faults = part.faults;
  }
  return model;
}

// A run's partner in another model: same scene, method and seed.
using Cell = std::tuple<std::string, std::string, int>;
struct Outcome {
  double error = 0.0, frame_ms = 0.0;
};
using Outcomes = std::map<Cell, Outcome>;

double NumberOf(const RunRecord& record, const std::string& key) {
  const double value = MetricValue(record, key);
  if (!std::isnan(value)) return value;
  throw ConfigError(fmt::format("sufficient: run {} has no metric \"{}\"", record.run_id, key));
}

class Search {
 public:
  Search(const fs::path& file, const SufficiencySettings& settings, const fs::path& folder,
         const fs::path& program)
      : file_(file),
        settings_(settings),
        folder_(folder),
        program_(program),
        experiment_(ReadSettingsFile<ExperimentSettings>(file)) {
    if (FindMetric(settings.metric).better != Better::kLower) {
      throw ConfigError(
          fmt::format("sufficient: metric \"{}\": expected an error, of which less is better; {}",
                      settings.metric, Name(FindMetric(settings.metric).better)));
    }
    if (experiment_.variants.empty()) {
      throw ConfigError(
          fmt::format("{}: variants: expected the parts to leave out, one variant each, got none",
                      file.string()));
    }
  }

  const Parts& parts() const { return experiment_.variants; }

  // Carries out the models' runs, and says what each model costs.
  std::vector<ModelCost> CostsOf(const std::vector<VariantSettings>& models) {
    ExperimentSettings settings = experiment_;
    settings.variants = models;
    const ExperimentPlan plan = PlanExperiment(settings, file_);
    const std::vector<PlannedRun> runs =
        PlannedRuns(plan, {folder_ / "sequences", folder_ / "learned"});
    const ExperimentOutcome outcome = CarryOutRuns(runs, settings_.jobs, folder_, program_);
    if (outcome.failed > 0) {
      throw RunError(fmt::format("sufficient: {} of {} runs failed; see {}", outcome.failed,
                                 runs.size(), folder_.string()));
    }
    std::map<std::string, Outcomes> by_model;
    for (const RunPlan& run : plan.runs) {
      const RunRecord record = ReadRunRecord(folder_, run.run_id);
      by_model[run.variant][{run.scene, run.method_name, run.seed}] = {
          NumberOf(record, settings_.metric), NumberOf(record, "frame_ms_median")};
    }
    if (full_.empty()) full_ = by_model.at(kFullModel);
    std::vector<ModelCost> costs;
    for (const VariantSettings& model : models) costs.push_back(CostOf(by_model.at(model.name)));
    return costs;
  }

 private:
  ModelCost CostOf(const Outcomes& outcomes) const {
    std::vector<double> errors, ratios, frame_ms;
    for (const auto& [cell, outcome] : outcomes) {
      errors.push_back(outcome.error);
      ratios.push_back(outcome.error / full_.at(cell).error);
      frame_ms.push_back(outcome.frame_ms);
    }
    return {Mean(errors), Mean(ratios), Mean(frame_ms)};
  }

  fs::path file_;
  SufficiencySettings settings_;
  fs::path folder_, program_;
  ExperimentSettings experiment_;
  Outcomes full_;
};

Json ToJson(const ModelCost& cost) {
  return {{"error", cost.error}, {"error_ratio", cost.error_ratio}, {"frame_ms", cost.frame_ms}};
}

}  // namespace

Sufficiency FindSufficient(const fs::path& experiment_file, const SufficiencySettings& settings,
                           const fs::path& folder, const fs::path& program) {
  Search search(experiment_file, settings, folder, program);
  Sufficiency result;
  result.full = result.smallest = search.CostsOf({Without({})}).front();
  Parts gone, left = search.parts();
  while (!left.empty()) {
    std::vector<VariantSettings> models;
    for (const VariantSettings& part : left) {
      Parts parts = gone;
      parts.push_back(part);
      models.push_back(Without(parts));
    }
    const std::vector<ModelCost> costs = search.CostsOf(models);
    SufficiencyRound& round = result.rounds.emplace_back();
    std::size_t best = left.size();
    for (std::size_t i = 0; i < left.size(); ++i) {
      const bool is_sufficient = costs[i].error_ratio <= 1.0 + settings.margin;
      round.trials.push_back({left[i].name, costs[i], is_sufficient});
      const double to_beat = best < left.size() ? costs[best].frame_ms : result.smallest.frame_ms;
      if (is_sufficient && costs[i].frame_ms < to_beat) best = i;
    }
    if (best == left.size()) break;
    round.left_out = left[best].name;
    result.smallest = costs[best];
    result.left_out.push_back(left[best].name);
    gone.push_back(left[best]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return result;
}

Json ToJson(const Sufficiency& result, const SufficiencySettings& settings) {
  Json rounds = Json::array();
  for (const SufficiencyRound& round : result.rounds) {
    Json trials = Json::array();
    for (const SufficiencyRound::Trial& trial : round.trials) {
      Json row = ToJson(trial.cost);
      row["part"] = trial.part;
      row["is_sufficient"] = trial.is_sufficient;
      trials.push_back(row);
    }
    rounds.push_back({{"trials", trials}, {"left_out", round.left_out}});
  }
  return {{"metric", settings.metric},   {"margin", settings.margin},
          {"full", ToJson(result.full)}, {"smallest", ToJson(result.smallest)},
          {"left_out", result.left_out}, {"rounds", rounds}};
}

}  // namespace vitruvia
