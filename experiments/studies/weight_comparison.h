// Tests whether skinning weights are the same for all people (paper A, sec. 4): learns them on
// several people, compares them, and applies them to each other.
#pragma once

#include <string>
#include <vector>

#include "config/json_settings.h"
#include "subjects/learned_model.h"

namespace vitruvia {

struct WeightComparison {
  std::vector<std::string> names;  // N subjects, then "rig": the database's reference weights
  std::vector<int> alternations;   // per subject
  // Of the subject's own weights with their transforms, RMSE of a vertex.
  std::vector<double> own_rmse_m;
  // [weights of][applied to]: RMSE with the transforms fitted again. N + 1 rows, N columns.
  std::vector<std::vector<double>> swapped_rmse_m;
  // [one][other]: half the sum of absolute differences of a vertex's weights, 0 … 1: the share of
  // it that follows other bones. N + 1 rows, N columns.
  std::vector<std::vector<double>> difference_mean, difference_p95;
};

// Learns on every subject of the database that has pose examples.
WeightComparison CompareWeights(const BodyDatabase& database, const skinning::Settings& settings);

Json ToJson(const WeightComparison& comparison);
void Print(const WeightComparison& comparison);

}  // namespace vitruvia
