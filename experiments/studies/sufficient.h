// The smallest sufficient model for a scene: parts are removed one after the other as long as the
// error stays within a margin of the full model's.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/plan/experiment_config.h"

namespace vitruvia {

struct SufficiencySettings {
  std::string metric = "joint_error_mean_m";  // a key of the catalogue; less is better
  double margin = 0.05;                       // share of the full model's error
  int jobs = 1;                               // runs at a time
};

// Costs of a model compared with the full one on the same scenes and seeds.
struct ModelCost {
  double error = 0.0;        // mean of the metric
  double error_ratio = 0.0;  // mean over pairs of a run's error divided by the full model's
  double frame_ms = 0.0;     // mean of the runs' medians
};

// A round removes one more part than the round before; it tries each remaining part.
struct SufficiencyRound {
  struct Trial {
    std::string part;
    ModelCost cost;
    bool is_sufficient = false;
  };
  std::vector<Trial> trials;
  std::string left_out;  // the part whose removal saves most; "" if the search ends here
};

struct Sufficiency {
  ModelCost full, smallest;
  std::vector<std::string> left_out;  // in order
  std::vector<SufficiencyRound> rounds;
};

// The experiment's variants are the parts: each one's overrides leave something out. The full model
// is the experiment without any of them. Runs are kept in `folder`, and found again by the next
// call. ConfigError if there are no parts or runs lack the metric; RunError if a run fails.
Sufficiency FindSufficient(const std::filesystem::path& experiment_file,
                           const SufficiencySettings& settings,
                           const std::filesystem::path& folder);

Json ToJson(const Sufficiency& result, const SufficiencySettings& settings);

}  // namespace vitruvia
