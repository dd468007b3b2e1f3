#include "layering.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vitruvia::lint {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Three floors and two methods; each test adds the file that it is about.
std::vector<SourceFile> House(std::vector<SourceFile> more = {}) {
  std::vector<SourceFile> tree = {
      {"src/ground/CMakeLists.txt",
       "# add_module(unreal DEPENDS nothing)\n"
       "add_module(ground\n  LINKS json::json  # a comment (with brackets)\n  OFFERS json/)\n"
       "set(OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/made.h)\n"},
      {"src/ground/error.h", "#pragma once\n#include <string>\n#include <json/json.h>\n"},
      {"src/middle/CMakeLists.txt", "add_module(middle DEPENDS ground HIDES mesh/ vtk)\n"},
      {"src/middle/clean.h", "#include \"ground/error.h\"\n"},
      {"src/middle/inner.h", "#include <mesh/mesh.h>\n"},
      {"src/middle/leaky.h", "#include \"middle/inner.h\"\n"},
      {"src/middle/clean.cpp", "#include \"middle/clean.h\"\n#include \"middle/leaky.h\"\n"},
      {"attic/CMakeLists.txt", "add_module(attic DEPENDS middle)\n"},
      {"attic/attic.h", "#include \"middle/clean.h\"\n#include <json/json.h>\n"},
      {"src/methods/CMakeLists.txt", "add_module(methods DEPENDS one two)\n"},
      {"src/methods/registry.cpp",
       "#include \"methods/one/one.h\"\n#include \"methods/two/two.h\"\n"},
      {"src/methods/one/CMakeLists.txt", "add_module(one DEPENDS ground)\n"},
      {"src/methods/one/one.h", "#include \"ground/error.h\"\n"},
      {"src/methods/two/CMakeLists.txt", "add_module(two)\n"},
      {"src/methods/two/two.h", "#include <vector>\n"}};
  for (SourceFile& file : more) tree.push_back(std::move(file));
  return tree;
}

std::vector<std::string> Check(std::vector<SourceFile> more) {
  return LayeringViolations(House(std::move(more)));
}

TEST(LayeringLint, AcceptsATidyHouse) { EXPECT_THAT(Check({}), IsEmpty()); }

TEST(LayeringLint, AcceptsStandardGeneratedAndOwnHeaders) {
  EXPECT_THAT(Check({{"src/ground/a.cpp",
                      "#include <vector>\n#include <unistd.h>\n#include <sys/stat.h>\n"
                      "#include \"ground/error.h\"\n#include \"made.h\"\n"}}),
              IsEmpty());
}

TEST(LayeringLint, FindsAnIncludeOfAModuleThatIsNotInDepends) {
  EXPECT_THAT(Check({{"src/ground/up.cpp", "\n#include \"middle/clean.h\"\n"}}),
              ElementsAre("src/ground/up.cpp:2: \"middle/clean.h\" is of module middle, which is "
                          "not in the DEPENDS of ground"));
  // What a dependency depends on is not yet one's own dependency.
  EXPECT_THAT(Check({{"attic/a.cpp", "#  include \"ground/error.h\"\n"}}),
              ElementsAre("attic/a.cpp:1: \"ground/error.h\" is of module ground, which is not in "
                          "the DEPENDS of attic"));
}

TEST(LayeringLint, FindsHeadersThatAreNobodys) {
  EXPECT_THAT(Check({{"src/middle/a.cpp", "#include \"made.h\"\n"}}),
              ElementsAre("src/middle/a.cpp:1: \"made.h\" is no header of a module, seen from src/ "
                          "or the top"));
  EXPECT_THAT(Check({{"src/middle/a.cpp", "#include \"tests/support/tiny.h\"\n"}}),
              ElementsAre("src/middle/a.cpp:1: \"tests/support/tiny.h\" is no header of a module, "
                          "seen from src/ or the top"));
  EXPECT_THAT(Check({{"src/middle/a.cpp", "#include <ground/error.h>\n"}}),
              ElementsAre("src/middle/a.cpp:1: <ground/error.h> is our own header; write it in "
                          "quotes"));
  EXPECT_THAT(Check({{"src/stray.h", ""}}), ElementsAre("src/stray.h: belongs to no module"));
}

TEST(LayeringLint, FindsCyclesUnknownAndRepeatedModules) {
  EXPECT_THAT(Check({{"src/x/CMakeLists.txt", "add_module(x DEPENDS y)"},
                     {"src/y/CMakeLists.txt", "add_module(y DEPENDS ground x)"}}),
              ElementsAre("x: depends on itself: x → y → x", "y: depends on itself: y → x → y"));
  EXPECT_THAT(Check({{"src/x/CMakeLists.txt", "add_module(x DEPENDS cellar)"}}),
              ElementsAre("x: DEPENDS names cellar, which is no module"));
  EXPECT_THAT(Check({{"src/x/CMakeLists.txt", "add_module(ground)"}}),
              ElementsAre("src/x/CMakeLists.txt: module ground is declared twice"));
}

TEST(LayeringLint, FindsADependencyThatNoFileNeeds) {
  EXPECT_THAT(Check({{"src/x/CMakeLists.txt", "add_module(x DEPENDS ground middle)"},
                     {"src/x/a.cpp", "#include \"ground/error.h\"\n"}}),
              ElementsAre("x: DEPENDS names middle, which no file of it includes"));
}

TEST(LayeringLint, KeepsMethodsApart) {
  EXPECT_THAT(Check({{"src/methods/three/CMakeLists.txt", "add_module(three DEPENDS one)"},
                     {"src/methods/three/a.cpp", "#include \"methods/one/one.h\"\n"}}),
              ElementsAre("three: DEPENDS names the method one; only src/methods may"));
  EXPECT_THAT(Check({{"src/methods/two/a.cpp", "#include \"methods/one/one.h\"\n"}}),
              ElementsAre("src/methods/two/a.cpp:1: \"methods/one/one.h\" is of module one, which "
                          "is not in the DEPENDS of two"));
}

TEST(LayeringLint, FindsThirdPartyHeadersOutOfPlace) {
  EXPECT_THAT(
      Check({{"attic/a.cpp", "#include <mesh/mesh.h>\n"}, {"attic/b.cpp", "#include <vtkX.h>\n"}}),
      ElementsAre("attic/a.cpp:1: <mesh/mesh.h>: middle HIDES it",
                  "attic/b.cpp:1: <vtkX.h>: middle HIDES it"));
  EXPECT_THAT(Check({{"src/x/CMakeLists.txt", "add_module(x)"},
                     {"src/x/a.cpp", "#include <json/json.h>\n"}}),
              ElementsAre("src/x/a.cpp:1: <json/json.h>: ground OFFERS it but is not below x"));
  EXPECT_THAT(Check({{"attic/a.cpp", "#include <boost/any.hpp>\n#include <png.h>\n"}}),
              ElementsAre("attic/a.cpp:1: <boost/any.hpp>: no module declares it",
                          "attic/a.cpp:2: <png.h>: no module declares it"));
}

TEST(LayeringLint, FindsHiddenHeadersLeakingThroughPublicOnes) {
  EXPECT_THAT(Check({{"attic/a.cpp", "#include \"middle/leaky.h\"\n"}}),
              ElementsAre("attic/a.cpp:1: \"middle/leaky.h\" brings in <mesh/mesh.h>, which middle "
                          "HIDES"));
}

TEST(Layering, HoldsInThisTree) {
  const std::vector<SourceFile> tree = ReadModuleTree(VITRUVIA_SOURCE_DIR);
  ASSERT_GT(tree.size(), 50u) << "the lint has not found the tree in " << VITRUVIA_SOURCE_DIR;
  EXPECT_THAT(LayeringViolations(tree), IsEmpty());
}

}  // namespace
}  // namespace vitruvia::lint
