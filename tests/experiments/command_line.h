// Calls of the command line from tests, and files of small experiments to call it with.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/json_settings.h"
#include "core/error.h"
#include "support/temporary_folder.h"

namespace vitruvia {

// The shipped configurations.
inline const std::filesystem::path kConfigs =
    std::filesystem::path(VITRUVIA_SOURCE_DIR) / "configs";

struct CallResult {
  int code;
  std::string out, error;
};

// The program itself, called with these arguments.
CallResult CallVitruvia(const std::vector<std::string>& arguments);

// Expects that exit code and all of the words in what is said on standard error.
void ExpectRefusal(const std::vector<std::string>& arguments, ExitCode code,
                   const std::vector<std::string>& words);

// A folder of the test's own with the tiny scene (a dozen small frames), the default method and an
// experiment of both.
class SmallExperiment {
 public:
  SmallExperiment();

  static Json Config();  // one run
  void Write(const std::string& name, const Json& json) const;
  std::string File(const std::string& name) const { return (folder_ / name).string(); }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  const std::filesystem::path& path() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
};

// Everything of a run's record but what a clock or this build says.
Json WithoutClock(Json record);

// What an experiment's folder says but for the clock: of every run by its id, and the summary.
Json ResultOf(const std::filesystem::path& experiment_folder);

}  // namespace vitruvia
