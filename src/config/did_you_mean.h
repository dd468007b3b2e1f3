// Suggestions for misspelt words.
#pragma once

#include <string>
#include <vector>

namespace vitruvia {

// The candidate nearest to `word` by edit distance, or "" if none is near.
std::string NearestWord(const std::string& word, const std::vector<std::string>& candidates);

// `separator` and 'did you mean "…"?', for the end of a message; "" if no candidate is near.
std::string DidYouMean(const std::string& word, const std::vector<std::string>& candidates,
                       const char* separator = "; ");

}  // namespace vitruvia
