// The lint for types of one name: two definitions of one class in one namespace break the rule of
// one definition, and the linker joins their member functions without a word.
#pragma once

#include <string>
#include <vector>

#include "layering.h"

namespace vitruvia::lint {

// One line per type (class, struct, enum, union) that a second file defines in the same namespace.
// Types inside of functions, classes and unnamed namespaces are left out.
std::vector<std::string> TypesDefinedTwice(const std::vector<SourceFile>& tree);

}  // namespace vitruvia::lint
