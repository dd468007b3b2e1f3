#include "core/pattern.h"

#include <algorithm>
#include <fnmatch.h>

namespace vitruvia {

bool MatchesPattern(const std::string& pattern, const std::string& text) {
  return fnmatch(pattern.c_str(), text.c_str(), 0) == 0;
}

bool MatchesAny(const std::vector<std::string>& patterns, const std::string& text) {
  return patterns.empty() ||
         std::any_of(patterns.begin(), patterns.end(),
                     [&text](const std::string& pattern) { return MatchesPattern(pattern, text); });
}

}  // namespace vitruvia
