#include "experiments/cli/run_command.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <CLI/CLI.hpp>

#include "analysis/printed_metric.h"
#include "core/error.h"
#include "experiments/plan/run_selection.h"
#include "experiments/run/run_state.h"
#include "experiments/run/run_times.h"
#include "experiments/run/runner.h"
#include "experiments/studies/planned_experiment.h"
#include "records/metric_value.h"
#include "reports/pages/report.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr int kMostJobs = 1024;
constexpr std::size_t kNarrowestColumn = 10;  // characters

struct RunArguments {
  fs::path experiment, output;
  RunSelection selection;
  int jobs = 1;
  bool dry_run = false;
};

std::vector<RunRecord> FinishedRuns(const fs::path& folder, const std::vector<PlannedRun>& runs) {
  std::vector<RunRecord> finished;
  for (const PlannedRun& run : runs) {
    if (StatusOf(folder / run.run_id, run.key).state == RunState::kDone)
      finished.push_back(ReadRunRecord(folder, run.run_id));
  }
  return finished;
}

// The metrics of Place::kTerminal that some run has, one row for each finished run.
void PrintRows(const fs::path& folder, const std::vector<PlannedRun>& runs) {
  const std::vector<RunRecord> finished = FinishedRuns(folder, runs);
  std::vector<Metric> columns = MetricsShownIn(Place::kTerminal);
  std::erase_if(columns, [&](const Metric& column) {
    return std::all_of(finished.begin(), finished.end(),
                       [&](const RunRecord& run) { return std::isnan(MetricValue(run, column)); });
  });
  std::size_t widest = 0;
  for (const PlannedRun& run : runs) widest = std::max(widest, run.run_id.size());
  const auto width_of = [](const Metric& c) {
    return std::max(kNarrowestColumn, Titled(c).size());
  };
  fmt::print("{:<{}}", "run", widest);
  for (const Metric& column : columns) fmt::print("  {:>{}}", Titled(column), width_of(column));
  fmt::print("\n");
  for (const RunRecord& run : finished) {
    fmt::print("{:<{}}", run.run_id, widest);
    for (const Metric& column : columns) {
      const double value = MetricValue(run, column);
      fmt::print("  {:>{}}", std::isnan(value) ? kNoNumber : Printed(value, column),
                 width_of(column));
    }
    fmt::print("\n");
  }
}

// A shard draws no report of half an experiment: the one that finds all runs settled does.
void FinishExperiment(const fs::path& folder, bool is_shard) {
  const int missing = WriteSummary(folder);
  if (is_shard && missing > 0) {
    fmt::print("{} runs of other shards are not done yet: no report\n", missing);
    return;
  }
  const FileLock lock = LockExperiment(folder);  // others may have come to their end too
  fmt::print("report: {}\n", WriteReport(folder).string());
}

void CarryOut(const PlannedExperiment& plan, const std::vector<PlannedRun>& runs,
              const RunArguments& arguments) {
  WritePlan(plan.experiment, plan.folder);
  const ExperimentOutcome outcome = CarryOutRuns(runs, arguments.jobs, plan.folder);
  PrintRows(plan.folder, runs);
  fmt::print("{} runs done, {} kept, {} failed\n", outcome.done, outcome.kept, outcome.failed);
  FinishExperiment(plan.folder, !arguments.selection.shard.empty());
  if (outcome.failed > 0)
    throw RunError(fmt::format("{} of {} runs failed", outcome.failed, runs.size()));
}

// What is left to do, and how long that would take if stored runs tell.
class Workload {
 public:
  void Add(RunState state, std::optional<double> seconds) {
    if (state == RunState::kDone) return;
    ++left_;
    if (!seconds) ++unknown_;
    seconds_ += seconds.value_or(0.0);
  }

  std::string Text(std::size_t runs, int jobs) const {
    const std::string head = fmt::format("{} runs, {} to be carried out: ", runs, left_);
    if (left_ == 0) return head + "nothing to do";
    if (left_ == unknown_)
      return head + "time unknown: no stored run has their method and number of frames";
    return head +
           fmt::format("about {:.0f} s of work, with {} at a time {:.0f} s", seconds_, jobs,
                       seconds_ / jobs) +
           (unknown_ > 0 ? fmt::format(", and {} runs of unknown time", unknown_) : "");
  }

 private:
  int left_ = 0, unknown_ = 0;
  double seconds_ = 0.0;
};

void PrintPlan(const PlannedExperiment& plan, const std::vector<PlannedRun>& runs, int jobs) {
  const RunTimes times(plan.root);
  Workload workload;
  fmt::print("{:<8} {:>8}  run\n", "state", "time");
  for (const PlannedRun& run : runs) {
    const RunState state = StatusOf(plan.folder / run.run_id, run.key).state;
    const std::optional<double> seconds = times.Estimate(run);
    workload.Add(state, seconds);
    fmt::print("{:<8} {:>8}  {}\n", Name(state),
               seconds ? fmt::format("{:.1f} s", *seconds) : "unknown", run.run_id);
  }
  fmt::print("{}\n", workload.Text(runs.size(), jobs));
}

void Run(const RunArguments& arguments) {
  const PlannedExperiment plan = PlanForOutput(arguments.experiment, arguments.output);
  const std::vector<PlannedRun> runs = SelectedRuns(plan.experiment.runs, arguments.selection);
  if (arguments.dry_run) {
    PrintPlan(plan, runs, arguments.jobs);
  } else {
    CarryOut(plan, runs, arguments);
  }
}

}  // namespace

void AddRunCommand(CLI::App& app) {
  auto a = std::make_shared<RunArguments>();
  CLI::App* run = app.add_subcommand("run", "Carry out an experiment and write its report");
  run->add_option("EXPERIMENT", a->experiment, "experiment file")->required();
  run->add_option("-o,--output", a->output, "the experiment's folder; out/NAME without");
  run->add_option("--only", a->selection.only,
                  "only runs whose id, variant or scene matches this pattern (* ? [abc])");
  run->add_option("--shard", a->selection.shard,
                  "i/n: only every n-th run from the i-th; the shards share one output folder");
  run->add_option("-j,--jobs", a->jobs,
                  "runs at a time; those of an experiment with \"timed\": true go alone")
      ->check(CLI::Range(1, kMostJobs));
  run->add_flag("--dry-run", a->dry_run,
                "only print the runs, how far each is, and an estimate of the time");
  run->callback([a] { Run(*a); });
}

}  // namespace vitruvia
