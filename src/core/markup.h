// Text inside HTML and XML.
#pragma once

#include <string>

namespace vitruvia {

// With & < > " as entities, and a space for each control character, which XML cannot hold, but line
// ends and tabs.
std::string Escaped(const std::string& text);

}  // namespace vitruvia
