// Text inside HTML and XML.
#pragma once

#include <string>

namespace vitruvia {

// Writes & < > " as entities and replaces control characters that XML does not allow (all but line
// ends and tabs) by spaces.
std::string Escaped(const std::string& text);

}  // namespace vitruvia
