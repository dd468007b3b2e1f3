// No two types of one name in one namespace, in the whole tree.
#include "type_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vitruvia::lint {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(TypeNameLint, FindsATypeThatTwoFilesDefine) {
  EXPECT_THAT(TypesDefinedTwice({{"src/a/a.h", "namespace v {\nstruct Finding { int a; };\n}"},
                                 {"src/b/b.cpp", "namespace v { class Finding : A { }; }"}}),
              ElementsAre("src/b/b.cpp: v::Finding is defined in src/a/a.h too"));
  EXPECT_THAT(TypesDefinedTwice({{"src/a/a.h", "namespace v::w { enum class Kind : int { kA }; }"},
                                 {"src/b/b.h", "namespace v { namespace w { union Kind {}; } }"}}),
              ElementsAre("src/b/b.h: v::w::Kind is defined in src/a/a.h too"));
}

TEST(TypeNameLint, LeavesOtherScopesAndDeclarationsAlone) {
  const SourceFile first{"src/a/a.h", "namespace v {\nstruct Finding { int a; };\n}"};
  for (const char* other :
       {"namespace v { struct Finding; }", "namespace v { namespace { struct Finding {}; } }",
        "namespace w { struct Finding {}; }", "namespace v { struct A { struct Finding {}; }; }",
        "namespace v { void F() { struct Finding { }; } }", "// namespace v { struct Finding {}; }",
        "namespace v { const char* t = \"struct Finding {\"; }",
        "namespace v { void F(struct Finding* f) {} }"}) {
    EXPECT_THAT(TypesDefinedTwice({first, {"src/b/b.cpp", other}}), IsEmpty()) << other;
  }
}

TEST(TypeNames, AreDefinedOnce) {
  EXPECT_THAT(TypesDefinedTwice(ReadModuleTree(VITRUVIA_SOURCE_DIR)), IsEmpty());
}

}  // namespace
}  // namespace vitruvia::lint
