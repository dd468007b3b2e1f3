// Each setting's meaning is shown alone by `vitruvia explain`, in schemas and in messages, so it
// may not continue the sentence of the setting before it.
#include <regex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "layering.h"

namespace vitruvia::lint {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// A meaning that begins with a conjunction or with a pronoun whose noun stands elsewhere.
constexpr const char* kContinuation =
    "meaning =\\s*\"((and|or|but|then|also|so|otherwise|meanwhile|likewise|again|it|its|they|their|"
    "them|this|these|those|that|there|the same|the other|the former|the latter) [^\"]*)";

std::vector<std::string> ContinuedMeanings(const std::string& text) {
  static const std::regex pattern(kContinuation, std::regex::optimize);
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), pattern); at != std::sregex_iterator();
       ++at) {
    found.push_back((*at)[1]);
  }
  return found;
}

TEST(MeaningLint, FindsAMeaningThatContinuesAnother) {
  EXPECT_THAT(ContinuedMeanings("{.meaning = \"stop below this step\"}, {.meaning = \"and above "
                                "this one\"}, {.meaning =\n \"its value\"}"),
              ElementsAre("and above this one", "its value"));
  EXPECT_THAT(ContinuedMeanings("{.meaning = \"its growth\"}"), ElementsAre("its growth"));
}

TEST(MeaningLint, AcceptsASentenceOfItsOwn) {
  EXPECT_THAT(ContinuedMeanings("{.meaning = \"upper bound of the search radius\"}"), IsEmpty());
  EXPECT_THAT(ContinuedMeanings("{.meaning = \"order of the frames and of the joints\"}"),
              IsEmpty());
}

TEST(Meanings, StandAlone) {
  for (const SourceFile& file : ReadModuleTree(VITRUVIA_SOURCE_DIR)) {
    EXPECT_THAT(ContinuedMeanings(file.text), IsEmpty()) << file.path;
  }
}

}  // namespace
}  // namespace vitruvia::lint
