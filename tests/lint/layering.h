// The layering lint: holds the #include lines of the tree against the add_module(...) calls of its
// CMakeLists.txt files (see cmake/AddModule.cmake for what DEPENDS, OFFERS and HIDES promise).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vitruvia::lint {

struct SourceFile {
  std::string path;  // from the top of the tree, with slashes
  std::string text;
};

// Every *.h, *.cpp and CMakeLists.txt of the folders that hold modules.
std::vector<SourceFile> ReadModuleTree(const std::filesystem::path& top);

// One line per breach of the rules, in the order of the files; empty when all is well.
//   own headers    only those of the own module or of a module in its DEPENDS, in quotes
//   DEPENDS        names modules that exist, without a cycle; modules below src/methods/ are named
//                  by src/methods/ alone, so siblings never know of each other
//   <prefix...>    only where the own module declares it, or a module below OFFERS it
//   HIDES          what a module hides does not leak out through a header that others include
std::vector<std::string> LayeringViolations(const std::vector<SourceFile>& tree);

}  // namespace vitruvia::lint
