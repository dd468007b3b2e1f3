// Runs that fail, crash, hang and are killed; several callers on one folder. The runs do no work of
// their own: what is tried is how they are carried out.
#include "experiments/run/runner.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "experiments/command_line.h"
#include "experiments/plan/run_selection.h"
#include "experiments/run/run_state.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

void SleepShortly() { std::this_thread::sleep_for(std::chrono::milliseconds(5)); }

// Runs r0, r1, … each of which writes its name and leaves a line in a common diary.
class Runner : public testing::Test {
 protected:
  // Runs that somebody times on this machine are not waited for: their lock lies in TMPDIR.
  Runner() { setenv("TMPDIR", diary_folder_.path().c_str(), 1); }
  ~Runner() override { unsetenv("TMPDIR"); }

  PlannedRun Run(const std::string& run_id) const {
    PlannedRun run;
    run.run_id = run_id;
    run.key = "key of " + run_id;
    run.variant = "v" + run_id;
    run.carry_out = [run_id, diary = diary_](const fs::path&) {
      std::ofstream(diary, std::ios::app) << run_id << "\n";
      RunRecord record;
      record.run_id = run_id;
      record.summary = {{"run_id", run_id}};
      return record;
    };
    return run;
  }

  Experiment Runs(int count) const {
    Experiment experiment;
    experiment.record.name = "fake";
    for (int i = 0; i < count; ++i) {
      experiment.runs.push_back(Run("r" + std::to_string(i)));
      experiment.record.run_ids.push_back(experiment.runs.back().run_id);
    }
    return experiment;
  }

  ExperimentOutcome CarryOut(const Experiment& experiment, int jobs = 1) const {
    WritePlan(experiment, folder_.path());
    const ExperimentOutcome outcome = CarryOutRuns(experiment.runs, jobs, folder_.path());
    WriteSummary(folder_.path());
    return outcome;
  }

  // A process of its own that carries out the runs; gone or not, it is waited for with Join().
  pid_t InAnotherProcess(const Experiment& experiment) const {
    const pid_t process = fork();
    if (process != 0) return process;
    CarryOut(experiment);
    _exit(0);
  }

  std::vector<std::string> Diary() const {
    std::ifstream file(diary_);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
  }

  RunState StateOf(const PlannedRun& run) const {
    return StatusOf(folder_ / run.run_id, run.key).state;
  }
  Json Summary() const { return ReadJsonFile(folder_ / "summary.json"); }

  TemporaryFolder folder_, diary_folder_;
  fs::path diary_ = diary_folder_ / "diary";
};

int Join(pid_t process) {
  int status = 0;
  waitpid(process, &status, 0);
  return status;
}

TEST_F(Runner, WhatIsDoneIsKept) {
  const Experiment experiment = Runs(3);
  EXPECT_EQ(CarryOut(experiment).done, 3);
  const ExperimentOutcome again = CarryOut(experiment);
  EXPECT_EQ(again.done, 0);
  EXPECT_EQ(again.kept, 3);
  EXPECT_THAT(Diary(), ElementsAre("r0", "r1", "r2"));
}

TEST_F(Runner, OtherSettingsOrAnotherBuildMakeAResultStale) {
  Experiment experiment = Runs(2);
  CarryOut(experiment);
  experiment.runs[1].key = "another key";
  EXPECT_EQ(StateOf(experiment.runs[1]), RunState::kStale);
  WritePlan(experiment, folder_.path());
  EXPECT_EQ(WriteSummary(folder_.path()), 1);
  EXPECT_EQ(Summary().at("rows").size(), 1u);  // a stale result is not read
  EXPECT_EQ(Summary().at("missing_runs"), Json({"r1"}));
  EXPECT_THAT(ReadExperimentRecord(folder_.path()).failed_runs.at("r1"), HasSubstr("stale"));
  EXPECT_EQ(CarryOut(experiment).done, 1);
  EXPECT_EQ(Summary().at("missing_runs"), Json::array());
  EXPECT_THAT(ReadExperimentRecord(folder_.path()).failed_runs, IsEmpty());
}

TEST_F(Runner, FailuresAndCrashesAreNamedAndTheOthersGoOn) {
  Experiment experiment = Runs(4);
  experiment.runs[1].carry_out = [](const fs::path&) -> RunRecord { throw DataError("no body"); };
  experiment.runs[2].carry_out = [](const fs::path&) -> RunRecord {
    std::signal(SIGSEGV, SIG_DFL);  // whatever a sanitizer makes of it
    std::raise(SIGSEGV);
    return {};
  };
  testing::internal::CaptureStderr();
  const ExperimentOutcome outcome = CarryOut(experiment, 2);
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              HasSubstr("run failed: r2: ended by signal 11 (Segmentation fault)"));
  EXPECT_EQ(outcome.done, 2);
  EXPECT_EQ(outcome.failed, 2);
  EXPECT_EQ(Summary().at("failed_runs"),
            Json({{"r1", "no body"}, {"r2", "ended by signal 11 (Segmentation fault)"}}));
  EXPECT_EQ(StateOf(experiment.runs[1]), RunState::kFailed);
  EXPECT_EQ(StateOf(experiment.runs[3]), RunState::kDone);
  EXPECT_EQ(CarryOut(Runs(4)).done, 2);  // a failed run is tried again
}

TEST_F(Runner, KilledInTheMiddleItLosesTheRunInFlightAndGoesOn) {
  Experiment experiment = Runs(3);
  const fs::path reached = diary_folder_ / "reached";
  experiment.runs[1].carry_out = [reached](const fs::path& run_folder) -> RunRecord {
    MakeFolder(run_folder / ".estimate.host-1.part");  // half-written work
    WriteWholeFile(reached, "");
    while (true) SleepShortly();
  };
  const pid_t killed = InAnotherProcess(experiment);
  while (!fs::exists(reached)) SleepShortly();
  EXPECT_EQ(StateOf(experiment.runs[1]), RunState::kRunning);
  kill(killed, SIGKILL);
  EXPECT_TRUE(WIFSIGNALED(Join(killed)));
  while (StateOf(experiment.runs[1]) == RunState::kRunning) SleepShortly();  // its child ends too
  EXPECT_EQ(StateOf(experiment.runs[1]), RunState::kMissing);

  const ExperimentOutcome outcome = CarryOut(Runs(3));
  EXPECT_EQ(outcome.kept, 1);
  EXPECT_EQ(outcome.done, 2);
  EXPECT_THAT(Diary(), ElementsAre("r0", "r1", "r2"));
  EXPECT_FALSE(fs::exists(folder_ / "r1" / ".estimate.host-1.part"));
}

TEST_F(Runner, TwoCallersShareTheWork) {
  Experiment experiment = Runs(12);
  for (PlannedRun& run : experiment.runs) {
    run.carry_out = [work = run.carry_out](const fs::path& run_folder) {
      SleepShortly();
      return work(run_folder);
    };
  }
  const pid_t other = InAnotherProcess(experiment);
  const ExperimentOutcome outcome = CarryOut(experiment);
  EXPECT_EQ(Join(other), 0);
  EXPECT_EQ(outcome.done + outcome.kept, 12);
  EXPECT_EQ(Diary().size(), 12u);  // none was done twice
  EXPECT_EQ(Summary().at("rows").size(), 12u);
}

TEST_F(Runner, SharedWorkIsDoneOnceByTheFirstAndAwaitedByTheOthers) {
  Experiment experiment = Runs(4);
  const CachedFolder shared(diary_folder_ / "shared", "work", {{"of", "all"}});
  for (PlannedRun& run : experiment.runs) {
    run.shares = shared;
    run.carry_out = [this, shared, work = run.carry_out](const fs::path& run_folder) {
      shared.GetOrBuild([this](const fs::path& folder) {
        SleepShortly();
        MakeFolder(folder);
        std::ofstream(diary_, std::ios::app) << "shared\n";
      });
      return work(run_folder);
    };
  }
  EXPECT_EQ(CarryOut(experiment, 4).done, 4);
  EXPECT_EQ(Diary().size(), 5u);
  EXPECT_EQ(Diary().front(), "shared");
  EXPECT_TRUE(shared.complete());
}

// How many runs went on at the same time at the most, by marks in the diary.
int MostAtATime(const std::vector<std::string>& diary) {
  int now = 0, most = 0;
  for (const std::string& line : diary) {
    if (line == "begin") most = std::max(most, ++now);
    if (line == "end") --now;
  }
  return most;
}

TEST_F(Runner, JobsGoTogetherAndTimedRunsAlone) {
  Experiment experiment = Runs(6);
  for (PlannedRun& run : experiment.runs) {
    run.carry_out = [this, work = run.carry_out](const fs::path& run_folder) {
      std::ofstream(diary_, std::ios::app) << "begin\n" << std::flush;
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      std::ofstream(diary_, std::ios::app) << "end\n" << std::flush;
      return work(run_folder);
    };
  }
  EXPECT_EQ(CarryOut(experiment, 3).done, 6);
  EXPECT_EQ(MostAtATime(Diary()), 3);
  fs::remove(diary_);
  for (PlannedRun& run : experiment.runs) {
    run.key += " timed";
    run.timed = true;
  }
  EXPECT_EQ(CarryOut(experiment, 3).done, 6);
  EXPECT_EQ(MostAtATime(Diary()), 1);
  const RunRecord record = ReadRunRecord(folder_.path(), "r0");
  EXPECT_EQ(record.provenance.at("run").at("timed"), true);
  EXPECT_EQ(record.provenance.at("run").at("jobs"), 1);
}

TEST_F(Runner, ShardsPartitionTheRunsInTheirOrder) {
  const std::vector<PlannedRun> runs = Runs(7).runs;
  const auto ids = [&runs](const RunSelection& selection) {
    std::vector<std::string> names;
    for (const PlannedRun& run : SelectedRuns(runs, selection)) names.push_back(run.run_id);
    return names;
  };
  EXPECT_THAT(ids({"", "1/3"}), ElementsAre("r0", "r3", "r6"));
  EXPECT_THAT(ids({"", "2/3"}), ElementsAre("r1", "r4"));
  EXPECT_THAT(ids({"", "3/3"}), ElementsAre("r2", "r5"));
  EXPECT_THAT(ids({"", "9/9"}), IsEmpty());
  EXPECT_THAT(ids({"r[46]", ""}), ElementsAre("r4", "r6"));
  EXPECT_THAT(ids({"vr[46]", "2/2"}), ElementsAre("r6"));
  for (const char* shard : {"0/3", "4/3", "1", "/", "1/", "-1/2", "1/2x", "a/b"}) {
    EXPECT_THROW(ids({"", shard}), ConfigError) << shard;
  }
  EXPECT_THROW(ids({"nothing*", ""}), ConfigError);
}

TEST_F(Runner, UnwritableFoldersAreToldAtOnce) {
  WriteWholeFile(folder_ / "file", "");
  EXPECT_THROW(CarryOutRuns(Runs(1).runs, 1, folder_ / "file"), RunError);
  EXPECT_THROW(WritePlan(Runs(1), folder_ / "file"), RunError);
}

}  // namespace
}  // namespace vitruvia
