#include "analysis/paired_differences.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

namespace vitruvia {
namespace {

// Who ran, and on which data; runs without a sequence have only their seed to tell it.
std::string MeasurementOf(const RunRecord& run) {
  const std::string data =
      run.sequence_hash.empty() ? fmt::format("seed {}", run.seed) : run.sequence_hash;
  return fmt::format("{}/{}\n{}", run.method, run.variant, data);
}

}  // namespace

void PairedDifferences::Add(const RunRecord& reference, const RunRecord& other, double difference) {
  const std::string name =
      fmt::format("{}\n{}\n{}", other.scene, MeasurementOf(reference), MeasurementOf(other));
  const auto found = std::find_if(measurements_.begin(), measurements_.end(),
                                  [&](const Measurement& m) { return m.name == name; });
  if (found == measurements_.end()) {
    measurements_.push_back({name, other.scene, {difference}});
  } else {
    found->repeats.push_back(difference);
  }
}

Groups PairedDifferences::Grouped() const {
  Groups groups;
  std::map<std::string, std::size_t> of_scene;
  for (const Measurement& measurement : measurements_) {
    const auto [place, is_new] = of_scene.emplace(measurement.scene, groups.size());
    if (is_new) groups.emplace_back();
    std::vector<double>& group = groups[place->second];
    const std::vector<double>& repeats = measurement.repeats;
    const bool agree = std::equal(repeats.begin() + 1, repeats.end(), repeats.begin());
    group.insert(group.end(), repeats.begin(), agree ? repeats.begin() + 1 : repeats.end());
  }
  return groups;
}

}  // namespace vitruvia
