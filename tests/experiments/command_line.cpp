#include "experiments/command_line.h"

#include <cstdlib>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "core/files.h"
#include "experiments/full_disk.h"
#include "experiments/run/machine_lock.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

Json RowWithoutClock(Json row) {
  for (const char* key : {"frame_ms_median", "frame_ms_p95", "frame_ms_max", "tracker_memory_mb"}) {
    row.erase(key);
  }
  return row;
}

}  // namespace

CallResult CallVitruvia(const std::vector<std::string>& arguments) {
  return CallWithFullDisk(RLIM_INFINITY, arguments);
}

CallResult CallWithFullDisk(rlim_t largest_file_bytes, const std::vector<std::string>& arguments) {
  std::vector<char*> argv = {const_cast<char*>(VITRUVIA_PROGRAM)};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  // Runs that somebody times on this machine are not waited for.
  static const TemporaryFolder locks;
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const pid_t process = fork();
  if (process == 0) {
    const rlimit limit{largest_file_bytes, largest_file_bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
    setenv(kLockFolderVariable, locks.path().c_str(), 1);
    execv(VITRUVIA_PROGRAM, argv.data());
    _exit(-1);
  }
  int status = 0;
  waitpid(process, &status, 0);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return {code, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

void ExpectRefusal(const std::vector<std::string>& arguments, ExitCode code,
                   const std::vector<std::string>& words) {
  const CallResult outcome = CallVitruvia(arguments);
  EXPECT_EQ(outcome.code, static_cast<int>(code)) << outcome.error;
  for (const std::string& word : words)
    EXPECT_NE(outcome.error.find(word), std::string::npos) << outcome.error;
}

SmallExperiment::SmallExperiment() {
  Json scene = ReadJsonFile(kConfigs / "scenes" / "small.json");
  scene["motion"]["file"] = (kConfigs / "motions" / "arm_wave.json").string();
  Write("scene.json", scene);
  Write("method.json", {{"method", "realtime_scape"}});
  Write("experiment.json", Config());
}

Json SmallExperiment::Config() {
  return {{"title", "Test"}, {"scenes", {"scene.json"}}, {"methods", {"method.json"}}};
}

void SmallExperiment::Write(const std::string& name, const Json& json) const {
  WriteWholeFile(folder_ / name, json.dump());
}

Json WithoutClock(Json record) {
  for (const char* key : {"provenance", "steps"}) record.erase(key);
  record["frames"].erase("frame_ms");
  record["summary"] = RowWithoutClock(record["summary"]);
  return record;
}

Json ResultOf(const fs::path& experiment_folder) {
  Json result = ReadJsonFile(experiment_folder / "summary.json");
  for (Json& row : result.at("variants").at("rows"))
    row.at("metrics") = RowWithoutClock(row.at("metrics"));
  for (Json& row : result.at("rows")) {
    const std::string run_id = row.at("run_id");
    row = RowWithoutClock(row);
    result["records"][run_id] =
        WithoutClock(ReadJsonFile(experiment_folder / run_id / "record.json"));
  }
  return result;
}

}  // namespace vitruvia
