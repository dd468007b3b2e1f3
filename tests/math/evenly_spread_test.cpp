#include "math/evenly_spread.h"

#include <gtest/gtest.h>

namespace vitruvia {
namespace {

TEST(EvenlySpread, TakesTheFirstAndTheLast) {
  EXPECT_EQ(EvenlySpread(10, 4), (std::vector<int>{0, 3, 6, 9}));
  EXPECT_EQ(EvenlySpread(10, 2), (std::vector<int>{0, 9}));
}

TEST(EvenlySpread, TakesAllOfFewAndTheFirstAlone) {
  EXPECT_EQ(EvenlySpread(3, 12), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(EvenlySpread(10, 1), (std::vector<int>{0}));
  EXPECT_TRUE(EvenlySpread(0, 5).empty());
  EXPECT_TRUE(EvenlySpread(5, 0).empty());
}

}  // namespace
}  // namespace vitruvia
