#include "analysis/tables.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "records/metric_value.h"
#include "tracking/realtime_scape_steps.h"

namespace vitruvia {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kRunColumn = "run_id";

// Paper A, table 1: milliseconds on one 3.4 GHz CPU, and 3.5 iterations a frame.
constexpr double kPaperIterations = 3.5;
struct PublishedStep {
  RealtimeScapeStep step;
  double ms;
  bool every_iteration;
};
constexpr std::array kTable1 = {PublishedStep{RealtimeScapeStep::kCloudTree, 4.2, false},
                                PublishedStep{RealtimeScapeStep::kRender, 0.5, true},
                                PublishedStep{RealtimeScapeStep::kModelTree, 1.5, true},
                                PublishedStep{RealtimeScapeStep::kClassify, 0.3, true},
                                PublishedStep{RealtimeScapeStep::kCorrespond, 1.8, true},
                                PublishedStep{RealtimeScapeStep::kAssemble, 0.9, true},
                                PublishedStep{RealtimeScapeStep::kSolve, 0.6, true},
                                PublishedStep{RealtimeScapeStep::kUpdate, 0.4, true}};
constexpr double kTable1Total_ms = 25.0;

ComparedRun Compare(const ReportedRun& run, const Expectation& e, const Metric& metric) {
  ComparedRun compared{run.run_id, kNoNumber, kNoNumber, Verdict::kNoResult, run.problem};
  if (!run.record) return compared;
  const double ours = MetricValue(*run.record, metric);
  if (std::isnan(ours)) return compared;
  compared.ours = Printed(ours, metric);
  if (!std::isnan(e.paper) && e.not_comparable.empty())
    compared.difference = PrintedSigned(ours - e.paper, metric);
  if (!e.not_comparable.empty())
    compared.verdict = Verdict::kNotComparable;
  else if (!std::isnan(e.at_most))
    compared.verdict = ours <= e.at_most ? Verdict::kMet : Verdict::kMissed;
  else if (!std::isnan(e.at_least))
    compared.verdict = ours >= e.at_least ? Verdict::kMet : Verdict::kMissed;
  else
    compared.verdict = Verdict::kNoTarget;
  return compared;
}

bool AnyHas(const std::vector<const RunRecord*>& runs, const std::string& key) {
  return std::any_of(runs.begin(), runs.end(),
                     [&](const RunRecord* run) { return run->summary.contains(key); });
}

// Keys of the rows that are no columns yet: an experiment's own summaries.
std::vector<std::string> MembersOf(const std::vector<const RunRecord*>& runs,
                                   const std::vector<Metric>& columns) {
  std::vector<std::string> keys;
  for (const RunRecord* run : runs) {
    for (const auto& item : run->summary.items()) {
      const bool known = std::find(keys.begin(), keys.end(), item.key()) != keys.end() ||
                         std::any_of(columns.begin(), columns.end(), [&](const Metric& column) {
                           return column.key == item.key();
                         });
      if (!known) keys.push_back(item.key());
    }
  }
  return keys;
}

// The run's name, then the metrics that some run has; all leading ones while no run has finished.
std::vector<Metric> ColumnsOf(const std::vector<const RunRecord*>& finished) {
  std::vector<Metric> columns, others;
  for (const Metric& metric : MetricCatalogue()) {
    const bool leads = metric.IsShownIn(Place::kSummaryTable);
    const bool is_used =
        AnyHas(finished, metric.key) || metric.key == kRunColumn || (leads && finished.empty());
    if (is_used) (leads ? columns : others).push_back(metric);
  }
  columns.insert(columns.end(), others.begin(), others.end());
  for (const std::string& key : MembersOf(finished, columns)) columns.push_back(FindMetric(key));
  return columns;
}

}  // namespace

std::vector<Comparison> CompareWithPapers(const ReportedExperiment& experiment) {
  std::vector<Comparison> comparisons;
  for (const Expectation& e : experiment.record.expectations) {
    Comparison comparison{e, FindMetric(e.metric), "", "", {}};
    comparison.paper = std::isnan(e.paper) ? kNoNumber : Printed(e.paper, comparison.metric);
    const double target = comparison.more_is_better() ? e.at_least : e.at_most;
    if (!std::isnan(target)) comparison.target = Printed(target, comparison.metric);
    for (const ReportedRun& run : experiment.runs) {
      if (run.record && !e.IsAbout(run.record->scene)) continue;
      comparison.runs.push_back(Compare(run, e, comparison.metric));
    }
    comparisons.push_back(std::move(comparison));
  }
  return comparisons;
}

SummaryTable MakeSummaryTable(const ReportedExperiment& experiment) {
  SummaryTable table;
  table.columns = ColumnsOf(experiment.finished());
  for (const ReportedRun& run : experiment.runs) {
    SummaryTable::Row row{run.run_id, run.problem, {}};
    for (const Metric& column : table.columns) {
      const bool has = run.record && run.record->summary.contains(column.key);
      row.cells.push_back(has ? run.record->summary.at(column.key) : nlohmann::json(nullptr));
    }
    row.cells.front() = run.run_id;
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::vector<StepRow> CompareSteps(const RunRecord& run) {
  std::vector<StepRow> rows;
  bool published = false;
  for (const RunRecord::Step& step : run.steps) {
    StepRow row{step.name, kNone, kNone, step.median_ms, step.p95_ms, step.max_ms};
    for (const PublishedStep& paper : kTable1) {
      if (step.name != Name(paper.step)) continue;
      published = true;
      if (paper.every_iteration) row.paper_per_iteration_ms = paper.ms;
      row.paper_per_frame_ms = paper.every_iteration ? kPaperIterations * paper.ms : paper.ms;
    }
    rows.push_back(row);
  }
  double slowest_ms = kNone;
  if (const auto times = run.frames.find("frame_ms");
      times != run.frames.end() && !times->second.empty()) {
    slowest_ms = *std::max_element(times->second.begin(), times->second.end());
  }
  rows.push_back({"whole frame", kNone, published ? kTable1Total_ms : kNone,
                  MetricValue(run, "frame_ms_median"), MetricValue(run, "frame_ms_p95"),
                  slowest_ms});
  return rows;
}

}  // namespace vitruvia
