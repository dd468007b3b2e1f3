// Settings of a tracker that runs as a separate program.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/settings.h"

namespace vitruvia::external {

struct Settings {
  std::filesystem::path program;  // relative to the method file; started without a shell
  std::vector<std::string> arguments;
  double answer_within_s = 60.0;

  void Describe(Fields& fields);
};

}  // namespace vitruvia::external
