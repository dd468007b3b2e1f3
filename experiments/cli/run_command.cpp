#include "experiments/cli/run_command.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <CLI/CLI.hpp>

#include "analysis/printed_metric.h"
#include "core/error.h"
#include "core/message.h"
#include "experiments/plan/run_selection.h"
#include "experiments/run/experiment_files.h"
#include "experiments/run/machine_lock.h"
#include "experiments/run/run_state.h"
#include "experiments/run/run_times.h"
#include "experiments/run/runner.h"
#include "experiments/studies/planned_experiment.h"
#include "records/metric_value.h"
#include "reports/pages/report.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kNarrowestColumn = 10;  // characters

constexpr const char* kRunFooter =
    "Each run is a process of its own. Timed runs (\"timed\": true) have the machine to "
    "themselves:\n"
    "every `vitruvia run` on it holds a lock file in /run/lock, or /tmp where that is not for all\n"
    "users to write; VITRUVIA_LOCK_DIR names another folder, which all jobs and users of the "
    "machine\n"
    "must share.\n"
    "Exit codes: 0 all done; 4 a run failed; 8 all done, but in some run more frames failed than\n"
    "failed_frames_limit allows (vitruvia explain experiment.failed_frames_limit).";

struct RunArguments {
  fs::path experiment, output;
  RunSelection selection;
  int jobs = 1;
  bool dry_run = false, again = false;
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

// The shard that finds no missing run draws the report; the others would draw only a part of it.
void FinishExperiment(const fs::path& folder, bool is_shard) {
  const int missing = WriteSummary(folder);
  if (is_shard && missing > 0) {
    fmt::print("{} runs of other shards are not done yet: no report\n", missing);
    return;
  }
  const FileLock lock = LockExperiment(folder);  // other shards may draw it now, too
  fmt::print("report: {}\n", WriteReport(folder).string());
}

// Throws unless all runs are done and none has too many failed frames.
void RequireSuccess(const PlannedExperiment& plan, const std::vector<PlannedRun>& runs,
                    const ExperimentOutcome& outcome) {
  int doubtful = 0;
  const double limit = plan.experiment.failed_frames_limit;
  for (const PlannedRun& run : runs) {
    const RunStatus status = StatusOf(plan.folder / run.run_id, run.key);
    if (!status.failures.AreMoreThan(limit)) continue;
    PrintMessage("{}: {}\n", run.run_id, status.failures.Text(limit));
    ++doubtful;
  }
  if (outcome.failed > 0)
    throw RunError(fmt::format("{} of {} runs failed", outcome.failed, runs.size()));
  if (doubtful > 0)
    throw Error(ExitCode::kFramesFailed,
                fmt::format("too many frames failed in {} of {} runs", doubtful, runs.size()));
}

// Removes only their status, so that readers of the folder still find the records.
void ForgetRuns(const fs::path& folder, const std::vector<PlannedRun>& runs) {
  for (const PlannedRun& run : runs) {
    const std::optional<FileLock> claim = ClaimRun(folder / run.run_id);
    if (!claim)
      throw RunError(
          fmt::format("{}: another process carries it out; it cannot begin again", run.run_id));
    MarkBegun(folder / run.run_id);
  }
}

ExperimentOutcome CarryOutOrSayHowFar(const PlannedExperiment& plan,
                                      const std::vector<PlannedRun>& runs, int jobs) {
  try {
    return CarryOutRuns(runs, jobs, plan.folder);
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInterrupted) throw;
    const auto done = std::count_if(runs.begin(), runs.end(), [&](const PlannedRun& run) {
      return StatusOf(plan.folder / run.run_id, run.key).state == RunState::kDone;
    });
    throw Error(ExitCode::kInterrupted, fmt::format("interrupted, {} of {} runs done; run again to "
                                                    "go on",
                                                    done, runs.size()));
  }
}

void CarryOut(const PlannedExperiment& plan, const std::vector<PlannedRun>& runs,
              const RunArguments& arguments) {
  MachineLockFile();  // reports its errors before anything is written
  WritePlan(plan.experiment, plan.file, plan.folder);
  if (arguments.again) ForgetRuns(plan.folder, runs);
  const ExperimentOutcome outcome = CarryOutOrSayHowFar(plan, runs, arguments.jobs);
  PrintRows(plan.folder, runs);
  fmt::print("{} runs done, {} kept, {} failed\n", outcome.done, outcome.kept, outcome.failed);
  FinishExperiment(plan.folder, !arguments.selection.shard.empty());
  RequireSuccess(plan, runs, outcome);
}

// The remaining runs, and an estimate of their time from stored runs.
class Workload {
 public:
  void Add(std::optional<double> seconds) {
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

void PrintPlan(const PlannedExperiment& plan, const std::vector<PlannedRun>& runs,
               const RunArguments& arguments) {
  const RunTimes times(plan.root);
  Workload workload;
  fmt::print("{:<8} {:>8}  run\n", "state", "time");
  for (const PlannedRun& run : runs) {
    const RunState state = StatusOf(plan.folder / run.run_id, run.key).state;
    const std::optional<double> seconds = times.Estimate(run);
    if (arguments.again || state != RunState::kDone) workload.Add(seconds);
    fmt::print("{:<8} {:>8}  {}\n", Name(state),
               seconds ? fmt::format("{:.1f} s", *seconds) : "unknown", run.run_id);
  }
  fmt::print("{}\n", workload.Text(runs.size(), arguments.jobs));
}

void Run(const RunArguments& arguments) {
  const PlannedExperiment plan = PlanForOutput(arguments.experiment, arguments.output);
  const std::vector<PlannedRun> runs = SelectedRuns(plan.experiment.runs, arguments.selection);
  if (arguments.dry_run) {
    PrintPlan(plan, runs, arguments);
  } else {
    CarryOut(plan, runs, arguments);
  }
}

}  // namespace

void AddRunCommand(CLI::App& app) {
  auto a = std::make_shared<RunArguments>();
  CLI::App* run = app.add_subcommand("run", "Run an experiment and write its report");
  run->add_option("EXPERIMENT", a->experiment, "experiment file")->required();
  run->add_option("-o,--output", a->output, "the experiment's folder; without it out/NAME");
  run->add_option("--only", a->selection.only,
                  "only runs whose id, variant or scene matches this pattern (* ? [abc])");
  run->add_option(
      "--shard", a->selection.shard,
      "i/n: only every n-th run, beginning with the i-th; the shards share one output folder");
  run->add_option("-j,--jobs", a->jobs,
                  "number of concurrent runs; timed runs are executed one by one")
      ->check(CLI::Range(1, kMostJobs));
  run->add_flag("--dry-run", a->dry_run,
                "only print the runs, the state of each, and an estimate of the time");
  run->add_flag("--again", a->again, "run the chosen runs again, including those that are done");
  run->footer(kRunFooter);
  run->callback([a] { Run(*a); });
}

}  // namespace vitruvia
