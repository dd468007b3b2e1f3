// The report's tables as plain text cells, and their CSV, LaTeX and Markdown forms.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "analysis/experiment_runs.h"
#include "analysis/printed_metric.h"

namespace vitruvia {

enum class Verdict { kNoTarget, kMet, kMissed, kNoResult, kNotComparable };

struct ComparedRun {
  std::string run_id;
  std::string ours, difference;  // printed; "–" where there is no number
  Verdict verdict = Verdict::kNoTarget;
  std::string problem;  // of a run without a record
};

// One published number and the corresponding numbers of all runs.
struct Comparison {
  Expectation expectation;
  Metric metric;
  std::string paper, target;  // printed; `target` is "" if there is none
  std::vector<ComparedRun> runs;

  bool more_is_better() const { return !std::isnan(expectation.at_least); }
};
std::vector<Comparison> CompareWithPapers(const ReportedExperiment& experiment);

// All summary rows. Columns: those of Place::kSummaryTable first, then the others that a run has,
// in the order of the catalogue.
struct SummaryTable {
  std::vector<Metric> columns;
  struct Row {
    std::string run_id, problem;
    std::vector<nlohmann::json> cells;  // as stored; null if the run has none
  };
  std::vector<Row> rows;
};
SummaryTable MakeSummaryTable(const ReportedExperiment& experiment);

// A run's step times and those of paper A's table 1, NaN if the paper has none.
struct StepRow {
  std::string name;
  double paper_per_iteration_ms, paper_per_frame_ms;
  double median_ms, p95_ms, max_ms;
};
std::vector<StepRow> CompareSteps(const RunRecord& run);

// One row per run: the stored numbers, then for each published number its value and the difference.
std::string ToCsv(const ReportedExperiment& experiment);
// Two tables: the variants (or the scenes of a single variant) with the experiment's table_columns,
// and the comparison with papers. A table without rows is left out.
std::string ToLatex(const ReportedExperiment& experiment);
std::string ToMarkdown(const ReportedExperiment& experiment);

}  // namespace vitruvia
