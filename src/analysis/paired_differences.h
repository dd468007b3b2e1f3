// Differences of pairs of runs, as the independent values that paired_comparison.h tests.
#pragma once

#include <string>
#include <vector>

#include "analysis/paired_comparison.h"
#include "records/run_record.h"

namespace vitruvia {

// Collects the differences of one metric. Pairs of the same methods and variants on the same
// sequences are repeats of one measurement: `repeats` of an experiment, and seeds that change
// nothing, such as those of a sensor without noise. Repeats that agree to the last bit, as all but
// times do, are one value.
class PairedDifferences {
 public:
  // `difference`: the metric of `other` minus that of `reference`. Both are of one scene.
  void Add(const RunRecord& reference, const RunRecord& other, double difference);

  // The values by scene, in the order in which they were added.
  Groups Grouped() const;

 private:
  struct Measurement {
    std::string name, scene;
    std::vector<double> repeats;
  };
  std::vector<Measurement> measurements_;
};

}  // namespace vitruvia
