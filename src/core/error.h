// Errors with context. Bad input and misuse throw; a numerical outcome is data and never throws.
//
// A message says what is wrong, where, what was expected and what was found. The class decides the
// exit code of the command line, so a script can tell a typing mistake from a damaged file.
#pragma once

#include <stdexcept>
#include <string>

#include <fmt/format.h>

namespace vitruvia {

// Exit codes of the command line.
enum class ExitCode : int {
  kSuccess = 0,
  kInternalError = 1,     // a defect of vitruvia itself
  kBadConfiguration = 2,  // wrong arguments or a wrong config file
  kBadData = 3,           // a missing, damaged or inconsistent input
  kFailedRun = 4,  // the work itself failed: output not writable, a run that ended in an error
  kAccuracyRegressed = 5,  // regression gate: some accuracy is worse than the baseline
  kSpeedRegressed = 6,     // regression gate: accuracy holds, but something is slower
  kNothingMeasured = 7,    // regression gate: some or all numbers of the baseline were not measured
  kFramesFailed = 8,  // the work is done, but more frames of a run failed than the limit allows
  kUnsupportedProcessor = 9,  // the processor lacks instructions that the program was built with
  kInterrupted = 130,         // stopped by the user
};

class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

struct ConfigError : Error {
  explicit ConfigError(const std::string& message) : Error(ExitCode::kBadConfiguration, message) {}
};
struct DataError : Error {
  explicit DataError(const std::string& message) : Error(ExitCode::kBadData, message) {}
};
struct RunError : Error {
  explicit RunError(const std::string& message) : Error(ExitCode::kFailedRun, message) {}
};

// Misuse of an interface by a caller: the message names the violated expectation and the values.
template <class... Args>
void Require(bool condition, fmt::format_string<Args...> message, Args&&... args) {
  if (!condition) throw std::invalid_argument(fmt::format(message, std::forward<Args>(args)...));
}

}  // namespace vitruvia
