#include "analysis/figure_records.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/pattern.h"
#include "math/statistics.h"
#include "records/metric_value.h"

namespace vitruvia {
namespace {

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

std::string RowName(const ShownTable& table, const RunRecord& run) {
  return table.rows == TableRows::kMethods ? run.method : ContenderOf(run);
}

TableRow& RowOf(std::vector<TableRow>& rows, const std::string& name) {
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const TableRow& row) { return row.name == name; });
  return found == rows.end() ? rows.emplace_back(TableRow{name, 0, {}}) : *found;
}

}  // namespace

ClaimDecision DecideFigure(const FigureRecords& records) {
  const ReproducedFigure& figure = records.figure;
  ClaimDecision decision = Decide(figure.tests, records.experiments);
  std::string reason = figure.cannot_be_tested;
  if (reason.empty()) reason = fmt::format("{}", fmt::join(records.problems, "; "));
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

std::vector<TableRow> Tabulate(const ShownTable& table,
                               const std::vector<ReportedExperiment>& experiments) {
  std::vector<const RunRecord*> runs;
  for (const ReportedExperiment& experiment : experiments) {
    for (const RunRecord* run : experiment.finished()) {
      if (MatchesAny(table.scenes, run->scene)) runs.push_back(run);
    }
  }
  std::vector<TableRow> rows;
  for (const RunRecord* run : runs) ++RowOf(rows, RowName(table, *run)).runs;
  for (TableRow& row : rows) {
    for (const std::string& key : table.metrics) {
      std::vector<double> values;
      for (const RunRecord* run : runs) {
        const double value = MetricValue(*run, key);
        if (RowName(table, *run) == row.name && !std::isnan(value)) values.push_back(value);
      }
      row.means.push_back(values.empty() ? kAbsent : Mean(values));
    }
  }
  return rows;
}

}  // namespace vitruvia
