// What settings mean, as `vitruvia explain` prints it.
#pragma once

#include <string>

namespace vitruvia {

// The settings whose dotted key begins with `key` or contains it as a part; all of them, one line
// each, for "". ConfigError naming the nearest key if there is none.
std::string Explain(const std::string& key);

}  // namespace vitruvia
