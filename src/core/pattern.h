// Matching of names against shell patterns.
#pragma once

#include <string>
#include <vector>

namespace vitruvia {

// Whether the pattern (* ? [abc]) matches the whole text.
bool MatchesPattern(const std::string& pattern, const std::string& text);
// Whether at least one of the patterns matches; an empty list matches every text.
bool MatchesAny(const std::vector<std::string>& patterns, const std::string& text);

}  // namespace vitruvia
