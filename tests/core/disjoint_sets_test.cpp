#include "core/disjoint_sets.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace vitruvia {
namespace {

// Against labels that are rewritten at every join.
TEST(DisjointSets, NamesEachSetAfterItsLowestMember) {
  constexpr int kCount = 60;
  RandomStream random(1, "joins");
  DisjointSets sets(kCount);
  std::vector<int> labels(kCount);
  std::iota(labels.begin(), labels.end(), 0);
  for (int join = 0; join < 80; ++join) {
    const int a = static_cast<int>(random.Index(kCount)),
              b = static_cast<int>(random.Index(kCount));
    const int low = std::min(labels[a], labels[b]), high = std::max(labels[a], labels[b]);
    EXPECT_EQ(sets.Join(a, b), low != high);
    std::replace(labels.begin(), labels.end(), high, low);
    for (int i = 0; i < kCount; ++i) ASSERT_EQ(sets.Find(i), labels[i]) << "after join " << join;
  }
}

}  // namespace
}  // namespace vitruvia
