// Estimates run times from stored runs.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/plan/planned_run.h"

namespace vitruvia {

class RunTimes {
 public:
  // Uses all records below the folder, of any build.
  explicit RunTimes(const std::filesystem::path& folder);

  // The median time of stored runs of the same method and frame count, seconds; nothing if there
  // are none.
  std::optional<double> Estimate(const PlannedRun& run) const;

 private:
  std::map<std::pair<std::string, int>, std::vector<double>> seconds_;
};

}  // namespace vitruvia
