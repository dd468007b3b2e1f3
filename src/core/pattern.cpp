#include "core/pattern.h"

#include <fnmatch.h>

namespace vitruvia {

bool MatchesPattern(const std::string& pattern, const std::string& text) {
  return fnmatch(pattern.c_str(), text.c_str(), 0) == 0;
}

}  // namespace vitruvia
