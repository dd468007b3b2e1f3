// Names chosen by patterns, as in a shell.
#pragma once

#include <string>
#include <vector>

namespace vitruvia {

// Whether the pattern (* ? [abc]) matches the whole text.
bool MatchesPattern(const std::string& pattern, const std::string& text);
// Whether one of the patterns does; a list without patterns stands for all texts.
bool MatchesAny(const std::vector<std::string>& patterns, const std::string& text);

}  // namespace vitruvia
