// Names chosen by patterns, as in a shell.
#pragma once

#include <string>

namespace vitruvia {

// Whether the pattern (* ? [abc]) matches the whole text.
bool MatchesPattern(const std::string& pattern, const std::string& text);

}  // namespace vitruvia
