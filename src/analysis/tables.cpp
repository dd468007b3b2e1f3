#include "analysis/tables.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "tracking/realtime_scape_steps.h"

namespace vitruvia {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

constexpr std::array kFirstColumns = {"run_id",
                                      "variant",
                                      "scene",
                                      "method",
                                      "seed",
                                      "frames",
                                      "frames_failed",
                                      "l2_mean_m",
                                      "l2_mean_of_diagonal",
                                      "l2_max_of_diagonal",
                                      "joint_error_mean_m",
                                      "joints_within_10cm",
                                      "frame_ms_median",
                                      "frame_ms_p95",
                                      "iterations_mean"};

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

const nlohmann::json* FindNumber(const RunRecord& run, const std::string& key) {
  const auto found = run.summary.find(key);
  return found != run.summary.end() && found->is_number() ? &*found : nullptr;
}

double NumberOrNone(const RunRecord& run, const std::string& key) {
  const nlohmann::json* number = FindNumber(run, key);
  return number == nullptr ? kNone : number->get<double>();
}

ComparedRun Compare(const ReportedRun& run, const Expectation& e, const MetricName& metric) {
  ComparedRun compared{run.run_id, "–", "–", Verdict::kNoResult, run.problem};
  if (!run.record) return compared;
  const double ours = NumberOrNone(*run.record, e.metric);
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

}  // namespace

std::vector<Comparison> CompareWithPapers(const ReportedExperiment& experiment) {
  std::vector<Comparison> comparisons;
  for (const Expectation& e : experiment.record.expectations) {
    Comparison comparison{e, NameOfMetric(e.metric), "", "", {}};
    comparison.paper = std::isnan(e.paper) ? "–" : Printed(e.paper, comparison.metric);
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
  const std::vector<const RunRecord*> finished = experiment.finished();
  std::vector<std::string> keys;
  for (const char* key : kFirstColumns) {  // without those that no run has, but for the run's name
    const bool used = finished.empty() || key == std::string("run_id") ||
                      std::any_of(finished.begin(), finished.end(), [key](const RunRecord* run) {
                        return run->summary.contains(key);
                      });
    if (used) keys.emplace_back(key);
  }
  std::vector<std::string> others;
  for (const RunRecord* run : finished) {
    for (const auto& item : run->summary.items()) {
      if (std::find(keys.begin(), keys.end(), item.key()) == keys.end() &&
          std::find(others.begin(), others.end(), item.key()) == others.end()) {
        others.push_back(item.key());
      }
    }
  }
  std::sort(others.begin(), others.end());
  keys.insert(keys.end(), others.begin(), others.end());

  SummaryTable table;
  for (const std::string& key : keys) table.columns.push_back(NameOfMetric(key));
  for (const ReportedRun& run : experiment.runs) {
    SummaryTable::Row row{run.run_id, run.problem, {}};
    for (const std::string& key : keys) {
      const bool has = run.record && run.record->summary.contains(key);
      row.cells.push_back(has ? run.record->summary.at(key) : nlohmann::json(nullptr));
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
                  NumberOrNone(run, "frame_ms_median"), NumberOrNone(run, "frame_ms_p95"),
                  slowest_ms});
  return rows;
}

}  // namespace vitruvia
