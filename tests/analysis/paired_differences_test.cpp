#include "analysis/paired_differences.h"

#include <gmock/gmock.h>

namespace vitruvia {
namespace {
using testing::ElementsAre;

RunRecord RunOf(const std::string& variant, const std::string& scene, int seed,
                const std::string& sequence_hash) {
  RunRecord run;
  run.method = "m";
  run.variant = variant;
  run.scene = scene;
  run.seed = seed;
  run.sequence_hash = sequence_hash;
  return run;
}

TEST(PairedDifferences, AreGroupedByScene) {
  PairedDifferences differences;
  for (const auto& [scene, seed, difference] :
       {std::tuple{"b", 1, 0.5}, {"a", 1, 0.25}, {"b", 2, 0.5}})
    differences.Add(RunOf("x", scene, seed, ""), RunOf("y", scene, seed, ""), difference);
  EXPECT_THAT(differences.Grouped(), ElementsAre(ElementsAre(0.5, 0.5), ElementsAre(0.25)));
}

TEST(PairedDifferences, OfOneSequenceThatAgreeAreOneValue) {
  PairedDifferences differences;
  for (int seed = 1; seed <= 8; ++seed)
    differences.Add(RunOf("x", "s", seed, "same"), RunOf("y", "s", seed, "same"), 0.5);
  EXPECT_THAT(differences.Grouped(), ElementsAre(ElementsAre(0.5)));
}

// Times, and trackers that draw random numbers.
TEST(PairedDifferences, OfOneSequenceThatDoNotAgreeAreAllValues) {
  PairedDifferences differences;
  for (const double difference : {0.5, 0.5, 0.75})
    differences.Add(RunOf("x", "s", 1, "same"), RunOf("y", "s", 1, "same"), difference);
  EXPECT_THAT(differences.Grouped(), ElementsAre(ElementsAre(0.5, 0.5, 0.75)));
}

// The same difference on sequences that are not the same is evidence each time, on whichever side
// they differ; so it is between other variants.
TEST(PairedDifferences, OfOtherSequencesOrVariantsAreValuesOfTheirOwn) {
  PairedDifferences differences;
  differences.Add(RunOf("x", "s", 1, "a"), RunOf("y", "s", 1, "a"), 0.5);
  differences.Add(RunOf("x", "s", 2, "b"), RunOf("y", "s", 2, "b"), 0.5);
  differences.Add(RunOf("x", "s", 3, "a"), RunOf("y", "s", 3, "c"), 0.5);
  differences.Add(RunOf("x", "s", 1, "a"), RunOf("z", "s", 1, "a"), 0.5);
  EXPECT_THAT(differences.Grouped(), ElementsAre(ElementsAre(0.5, 0.5, 0.5, 0.5)));
}

}  // namespace
}  // namespace vitruvia
