// Runs that fail, crash, hang and are killed; several callers on one folder. The runs do no work of
// their own (fake_runs/main.cpp): what is tried is how they are carried out.
#include "experiments/run/runner.h"

#include <array>
#include <condition_variable>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <mutex>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "experiments/command_line.h"
#include "experiments/fake_runs/fake_runs.h"
#include "experiments/plan/run_selection.h"
#include "experiments/run/experiment_files.h"
#include "experiments/run/machine_lock.h"
#include "experiments/run/run_state.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

void SleepShortly() { std::this_thread::sleep_for(std::chrono::milliseconds(5)); }

int Join(pid_t process) {
  int status = 0;
  waitpid(process, &status, 0);
  return status;
}

// Runs r0, r1, … each of which writes its name into a common diary.
class Runner : public testing::Test {
 protected:
  // Runs that somebody times on this machine are not waited for.
  Runner() { setenv(kLockFolderVariable, place_.path().c_str(), 1); }
  ~Runner() override { unsetenv(kLockFolderVariable); }

  // What run `i` does instead, as fake_runs understands it.
  void Do(PlannedRun& run, const std::string& does, int count = 0) const {
    run.resolved = {{"does", does}, {"place", place_.path().string()}, {"count", count}};
  }

  Experiment Runs(int count, const std::string& does = "write") const {
    Experiment experiment;
    experiment.record.name = "fake";
    for (int i = 0; i < count; ++i) {
      PlannedRun& run = experiment.runs.emplace_back();
      run.experiment = "fake";
      run.kind = "fake";
      run.run_id = "r" + std::to_string(i);
      run.key = "key of " + run.run_id;
      run.variant = "v" + run.run_id;
      run.work = {place_.path(), place_.path()};
      Do(run, does);
      experiment.record.run_ids.push_back(run.run_id);
    }
    return experiment;
  }

  ExperimentOutcome CarryOut(const Experiment& experiment, int jobs = 1) const {
    WritePlan(experiment, "", folder_.path());
    const ExperimentOutcome outcome =
        CarryOutRuns(experiment.runs, jobs, folder_.path(), VITRUVIA_FAKE_RUNS);
    WriteSummary(folder_.path());
    return outcome;
  }

  // Another caller, who carries out the runs in the same folder; its output goes to the file "said"
  // and its messages to "messages".
  pid_t AnotherCaller(const Experiment& experiment, int jobs = 1) const {
    WritePlan(experiment, "", folder_.path());
    const fs::path file = place_ / "runs.json";
    WriteWholeFile(file, WriteSettings(FakeRuns{experiment.runs}).dump());
    std::vector<std::string> words = {VITRUVIA_FAKE_RUNS, "carry-out", folder_.path().string(),
                                      std::to_string(jobs), file.string()};
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, (place_ / "said").c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0666);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, (place_ / "messages").c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0666);
    pid_t process = -1;
    EXPECT_EQ(posix_spawn(&process, VITRUVIA_FAKE_RUNS, &actions, nullptr, argv.data(), environ),
              0);
    posix_spawn_file_actions_destroy(&actions);
    return process;
  }

  std::vector<std::string> Lines(const std::string& name) const {
    std::ifstream file(place_ / name);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
  }
  std::vector<std::string> Diary() const { return Lines("diary"); }

  RunState StateOf(const PlannedRun& run) const {
    return StatusOf(folder_ / run.run_id, run.key).state;
  }
  void WaitFor(const std::string& name) const {
    while (!fs::exists(place_ / name)) SleepShortly();
  }
  Json Summary() const { return ReadJsonFile(folder_ / "summary.json"); }

  TemporaryFolder folder_, place_;
};

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
  WritePlan(experiment, "", folder_.path());
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
  Do(experiment.runs[1], "throw");
  Do(experiment.runs[2], "crash");
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

TEST_F(Runner, AProgramThatCannotBeStartedFailsEveryRunWithTheReason) {
  testing::internal::CaptureStderr();
  const ExperimentOutcome outcome =
      CarryOutRuns(Runs(2).runs, 1, folder_.path(), place_ / "no-such-program");
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              HasSubstr("no-such-program: cannot be started: No such file or directory"));
  EXPECT_EQ(outcome.failed, 2);
}

TEST_F(Runner, ARunWhoseFramesAllFailedIsAFailedRun) {
  Experiment experiment = Runs(2, "fail frames");
  Do(experiment.runs[0], "fail frames", 12);
  Do(experiment.runs[1], "fail frames", 9);
  const ExperimentOutcome outcome = CarryOut(experiment);
  EXPECT_EQ(outcome.failed, 1);
  EXPECT_EQ(outcome.done, 1);
  EXPECT_EQ(StatusOf(folder_ / "r0", experiment.runs[0].key).reason,
            "all of its 12 frames failed (the run's log says why)");
  const RunStatus doubtful = StatusOf(folder_ / "r1", experiment.runs[1].key);
  EXPECT_EQ(doubtful.state, RunState::kDone);
  EXPECT_TRUE(doubtful.failures.AreMoreThan(0.7));
  EXPECT_FALSE(doubtful.failures.AreMoreThan(0.75));
  EXPECT_EQ(doubtful.failures.Text(0.7), "9 of 12 frames failed, more than the limit of 70 %");
}

TEST_F(Runner, ADamagedRecordIsFoundNamedAndMadeAgain) {
  const Experiment experiment = Runs(3);
  CarryOut(experiment);
  const fs::path record = folder_ / "r1" / "record.json";
  const std::string whole = ReadWholeFile(record);
  WriteWholeFile(record, whole.substr(0, whole.size() / 2));
  const RunStatus status = StatusOf(folder_ / "r1", experiment.runs[1].key);
  EXPECT_EQ(status.state, RunState::kDamaged);
  EXPECT_THAT(status.reason, HasSubstr("record.json"));
  EXPECT_EQ(WriteSummary(folder_.path()), 1);  // the others can still be summed up
  EXPECT_EQ(Summary().at("rows").size(), 2u);
  EXPECT_EQ(Summary().at("missing_runs"), Json({"r1"}));
  EXPECT_EQ(CarryOut(experiment).done, 1);
  EXPECT_EQ(Summary().at("rows").size(), 3u);
}

TEST_F(Runner, KilledInTheMiddleItLosesTheRunInFlightAndGoesOn) {
  Experiment experiment = Runs(3);
  Do(experiment.runs[1], "hang");
  const pid_t killed = AnotherCaller(experiment);
  WaitFor("reached");
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

TEST_F(Runner, AskedToStopItStopsItsRunsAndSaysSo) {
  Experiment experiment = Runs(3);
  Do(experiment.runs[1], "hang");
  const pid_t stopped = AnotherCaller(experiment);
  WaitFor("reached");
  kill(stopped, SIGTERM);
  const int status = Join(stopped);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), static_cast<int>(ExitCode::kInterrupted));
  EXPECT_EQ(StateOf(experiment.runs[0]), RunState::kDone);
  EXPECT_EQ(StateOf(experiment.runs[1]), RunState::kMissing);
}

TEST_F(Runner, TwoCallersShareTheWork) {
  const Experiment experiment = Runs(12);
  const pid_t other = AnotherCaller(experiment);
  const ExperimentOutcome outcome = CarryOut(experiment);
  EXPECT_EQ(Join(other), 0);
  EXPECT_EQ(outcome.done + outcome.kept, 12);
  EXPECT_EQ(Diary().size(), 12u);  // none was done twice
  EXPECT_EQ(Summary().at("rows").size(), 12u);
}

TEST_F(Runner, SharedWorkIsDoneOnceByTheFirstAndAwaitedByTheOthers) {
  EXPECT_EQ(Join(AnotherCaller(Runs(4, "share"), 4)), 0);
  EXPECT_THAT(Lines("said"), ElementsAre("4 done, 0 kept, 0 failed"));
  EXPECT_EQ(Diary().size(), 5u);
  EXPECT_EQ(Diary().front(), "shared");
  EXPECT_TRUE(fs::is_directory(SharedWork(place_.path()).path()));
}

TEST_F(Runner, JobsGoTogether) {
  Experiment experiment = Runs(6);
  for (PlannedRun& run : experiment.runs) Do(run, "meet", 3);
  EXPECT_EQ(CarryOut(experiment, 3).done, 6);
  const std::vector<std::string> observations = Lines("observations");
  ASSERT_EQ(observations.size(), 6u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(observations[i], "3 running, machine shared");
  EXPECT_THAT(observations, Each(testing::MatchesRegex("[123] running, machine shared")));
  EXPECT_EQ(ReadRunRecord(folder_.path(), "r0").provenance.at("run").at("jobs"), 3);
}

TEST_F(Runner, TimedRunsGoAlone) {
  Experiment experiment = Runs(3);
  for (PlannedRun& run : experiment.runs) {
    Do(run, "meet", 1);
    run.timed = true;
  }
  EXPECT_EQ(CarryOut(experiment, 3).done, 3);
  EXPECT_EQ(Lines("observations").size(), 3u);
  EXPECT_THAT(Lines("observations"), Each("1 running, machine taken"));
  const RunRecord record = ReadRunRecord(folder_.path(), "r0");
  EXPECT_EQ(record.provenance.at("run").at("timed"), true);
  EXPECT_EQ(record.provenance.at("run").at("jobs"), 1);
}

TEST_F(Runner, TimedRunsWaitForOthersWhateverTheirTmpdir) {
  std::optional<FileLock> others = FileLock::Try(MachineLockFile(), LockKind::kShared);
  ASSERT_TRUE(others.has_value());
  Experiment experiment = Runs(1);
  experiment.runs[0].timed = true;
  const TemporaryFolder of_the_job;
  const char* tmpdir = std::getenv("TMPDIR");
  const std::string before = tmpdir == nullptr ? "" : tmpdir;
  setenv("TMPDIR", of_the_job.path().c_str(), 1);
  const pid_t timed = AnotherCaller(experiment);
  tmpdir == nullptr ? unsetenv("TMPDIR") : setenv("TMPDIR", before.c_str(), 1);
  while (Lines("messages").empty()) SleepShortly();
  EXPECT_THAT(Lines("messages").front(), HasSubstr("waiting: timed runs need the machine to "
                                                   "themselves"));
  EXPECT_THAT(Diary(), IsEmpty());
  others.reset();
  EXPECT_EQ(Join(timed), 0);
  EXPECT_THAT(Diary(), ElementsAre("r0"));
}

TEST_F(Runner, OtherThreadsOfTheCallerAreNoHindrance) {
  std::mutex mutex;
  std::condition_variable ended;
  bool end = false;
  std::thread idle([&] {
    std::unique_lock lock(mutex);
    ended.wait(lock, [&] { return end; });
  });
  EXPECT_EQ(CarryOut(Runs(2)).done, 2);
  {
    const std::lock_guard lock(mutex);
    end = true;
  }
  ended.notify_all();
  idle.join();
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
  EXPECT_THROW(CarryOutRuns(Runs(1).runs, 1, folder_ / "file", VITRUVIA_FAKE_RUNS), RunError);
  EXPECT_THROW(WritePlan(Runs(1), "", folder_ / "file"), RunError);
}

}  // namespace
}  // namespace vitruvia
