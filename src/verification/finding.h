// Findings of the checks of a sequence.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace vitruvia {

enum class Severity {
  kWarning,  // may be intended
  kError,    // cannot be true
};

struct Finding {
  Severity severity = Severity::kWarning;
  std::string text;  // file inside the sequence, place, evidence in numbers, likely cause
};
using Findings = std::vector<Finding>;

template <class... Args>
Finding Warning(fmt::format_string<Args...> text, Args&&... args) {
  return {Severity::kWarning, fmt::format(text, std::forward<Args>(args)...)};
}
template <class... Args>
Finding Impossible(fmt::format_string<Args...> text, Args&&... args) {
  return {Severity::kError, fmt::format(text, std::forward<Args>(args)...)};
}

}  // namespace vitruvia
