#include "analysis/figure_records.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/pattern.h"
#include "math/statistics.h"
#include "records/metric_value.h"

namespace vitruvia {
namespace {

bool MatchesAny(const std::vector<std::string>& patterns, const std::string& text) {
  return patterns.empty() ||
         std::any_of(patterns.begin(), patterns.end(),
                     [&text](const std::string& pattern) { return MatchesPattern(pattern, text); });
}

std::string ContenderOf(const RunRecord& run) { return run.method + "/" + run.variant; }

// "" if all runs are finished.
std::string UnfinishedProblem(const std::vector<ReportedExperiment>& experiments) {
  std::size_t runs = 0, unfinished = 0;
  std::string first;
  for (const ReportedExperiment& experiment : experiments) {
    for (const ReportedRun& run : experiment.runs) {
      ++runs;
      if (run.record) continue;
      ++unfinished;
      if (first.empty()) first = fmt::format("{}: {}", run.run_id, run.problem);
    }
  }
  if (runs == 0) return "no run belongs to it";
  if (unfinished == 0) return "";
  return fmt::format("{} of {} runs have no record; {}", unfinished, runs, first);
}

ContenderRow& RowOf(std::vector<ContenderRow>& rows, const std::string& contender) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const ContenderRow& row) {
    return row.contender == contender;
  });
  return found == rows.end() ? rows.emplace_back(ContenderRow{contender, 0, {}}) : *found;
}

}  // namespace

ClaimDecision DecideFigure(const FigureRecords& records) {
  const ReproducedFigure& figure = records.figure;
  ClaimDecision decision = Decide(figure.tests, records.experiments);
  std::string reason = figure.cannot_be_tested;
  if (reason.empty() && !records.problems.empty()) reason = records.problems.front();
  if (reason.empty()) reason = UnfinishedProblem(records.experiments);
  if (figure.claim.empty()) decision.reason.clear();  // no test was asked for
  if (reason.empty()) return decision;
  decision.verdict = ClaimVerdict::kCannotBeTested;
  decision.reason = reason;
  return decision;
}

ReportedExperiment RunsThatMatch(const ReportedExperiment& experiment, const std::string& contender,
                                 const std::vector<std::string>& scenes) {
  ReportedExperiment matching = experiment;
  std::erase_if(matching.runs, [&](const ReportedRun& run) {
    return !run.record || !MatchesPattern(contender, ContenderOf(*run.record)) ||
           !MatchesAny(scenes, run.record->scene);
  });
  return matching;
}

std::vector<ContenderRow> Tabulate(const ShownTable& table,
                                   const std::vector<ReportedExperiment>& experiments) {
  std::vector<const RunRecord*> runs;
  for (const ReportedExperiment& experiment : experiments) {
    for (const RunRecord* run : experiment.finished()) {
      if (MatchesAny(table.scenes, run->scene)) runs.push_back(run);
    }
  }
  std::vector<ContenderRow> rows;
  for (const RunRecord* run : runs) ++RowOf(rows, ContenderOf(*run)).runs;
  for (ContenderRow& row : rows) {
    for (const std::string& key : table.metrics) {
      std::vector<double> values;
      for (const RunRecord* run : runs) {
        const double value = MetricValue(*run, key);
        if (ContenderOf(*run) == row.contender && !std::isnan(value)) values.push_back(value);
      }
      row.means.push_back(values.empty() ? kAbsent : Mean(values));
    }
  }
  return rows;
}

}  // namespace vitruvia
