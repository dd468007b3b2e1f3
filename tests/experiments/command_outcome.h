// The command line, called as a shell would.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.h"
#include "experiments/commands.h"

namespace vitruvia {

struct CommandOutcome {
  ExitCode code;
  std::string out, error;
};

inline CommandOutcome CallCommand(const std::vector<std::string>& arguments) {
  std::vector<const char*> argv = {"vitruvia"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int code = RunCommandLine(static_cast<int>(argv.size()), argv.data());
  const std::string out = testing::internal::GetCapturedStdout();
  return {static_cast<ExitCode>(code), out, testing::internal::GetCapturedStderr()};
}

}  // namespace vitruvia
