// Checks of arguments that CLI11 has not.
#pragma once

#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vitruvia {

// A number within a range. CLI::Range compares, and so takes "nan" for one.
inline CLI::Validator NumberIn(double least, double most) {
  const std::string range = fmt::format("{:g} … {:g}", least, most);
  return {[=](std::string& text) {
            double number = 0.0;
            const bool is_number = CLI::detail::lexical_cast(text, number);
            return is_number && number >= least && number <= most
                       ? std::string()
                       : fmt::format("expected a number in {}, got {}", range, text);
          },
          "in " + range};
}

// An empty text stands for no choice in the program; given as an argument it is a variable of a
// script that was never set.
inline CLI::Validator NotEmpty() {
  return {[](std::string& text) {
            return text.empty() ? std::string("expected a value, got an empty text")
                                : std::string();
          },
          ""};
}

}  // namespace vitruvia
