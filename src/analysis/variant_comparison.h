// Comparison of variants over the runs of one experiment, or of two folders.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/experiment_runs.h"
#include "analysis/paired_comparison.h"
#include "analysis/printed_metric.h"
#include "analysis/text_table.h"

namespace vitruvia {

// All finished runs of one variant with one method.
struct Contender {
  // Variant, method or "method/variant", the shortest that distinguishes it from the others. If all
  // contenders were swept from the same variant, its name is left out.
  std::string name;
  std::vector<const RunRecord*> runs;
};
// In the order of the grid. They point into the experiment.
std::vector<Contender> ContendersOf(const ReportedExperiment& experiment);

// One metric of one contender against the reference, paired by scene, seed and repeat.
struct VariantComparison {
  Metric metric;
  std::string reference, other;
  int unpaired = 0;  // runs of either side without a partner: failed, missing, or not in the other
                     // grid
  SampleSpread reference_spread, other_spread;  // over the pairs
  PairedComparison comparison;
};

// The contender with all swept settings at their defaults; the first contender if there is no sweep
// or no such contender.
std::size_t DefaultContender(const ReportedExperiment& experiment,
                             const std::vector<Contender>& contenders);

// Compares every contender with `reference`; "": the default one. `metrics` empty: the experiment's
// table_columns, or else the most important ones available. A contender without any pair in a
// metric has no row for it. ConfigError if there is nothing to compare, or if a contender or metric
// does not exist.
std::vector<VariantComparison> CompareVariants(const ReportedExperiment& experiment,
                                               const std::string& reference,
                                               const std::vector<std::string>& metrics);

// Compares the runs of `other` with the runs of `reference` that have the same contender name,
// scene, seed and repeat. One row for each contender and metric, and one for all contenders
// together ("all") if there are several. ConfigError if no run has a partner.
std::vector<VariantComparison> CompareExperiments(const ReportedExperiment& reference,
                                                  const ReportedExperiment& other,
                                                  const std::vector<std::string>& metrics);

// One row of a contender: means over its scenes, seeds and repeats.
struct VariantSummary {
  struct Cell {
    SampleSpread spread;  // over all its finished runs that have the metric
    // Comparison with the reference over pairs; nothing for the reference itself or without a pair.
    std::optional<VariantComparison> difference;
    // Better than all others, and the difference to the second best is significant.
    bool is_best = false;
  };
  std::string name;
  int runs = 0;
  std::vector<Cell> cells;  // one for each metric of the table
};
struct VariantTable {
  std::string reference;
  std::vector<Metric> metrics;  // the experiment's table_columns, or the most important ones
  std::vector<VariantSummary> rows;
};
VariantTable TabulateVariants(const ReportedExperiment& experiment);
// For an experiment with a single contender: a row for each scene, over its seeds.
VariantTable TabulateScenes(const ReportedExperiment& experiment);
// Mean ± standard deviation of each cell; the best one bold if that is significant.
TextTable ToText(const VariantTable& table, const std::string& first_column);
// { "confidence", "reference", "rows": [ { "variant", "runs", "metrics": { … } } ] }
nlohmann::json ToJson(const VariantTable& table);

// "lower (better)", "higher (worse)", "difference not shown", "too few pairs".
std::string VerdictText(const VariantComparison& row);
// The mean difference as a percentage of the reference's mean, signed; "–" where that is 0.
std::string RelativeText(const VariantComparison& row);

nlohmann::json ToJson(const std::vector<VariantComparison>& rows);
std::string ToCsv(const std::vector<VariantComparison>& rows);
// Variant, mean ± standard deviation, difference, interval and pairs; differences that are shown
// are bold.
TextTable ToText(const std::vector<VariantComparison>& rows);

// The number of independent units: "8 scenes", or "6 pairs" of one scene.
std::string UnitsText(const PairedComparison& comparison);
// "mean ± deviation", scaled to the metric's unit; without the deviation if there is none.
std::string SpreadText(const SampleSpread& spread, const Metric& metric);
// "+1.2 … +1.6"; "–" if there is no interval.
std::string IntervalText(const VariantComparison& row);
// Description of the statistical method, in full sentences; `count` comparisons are corrected
// together.
std::string MethodText(std::size_t count);

}  // namespace vitruvia
