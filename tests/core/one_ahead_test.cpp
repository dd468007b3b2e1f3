#include "core/one_ahead.h"

#include <latch>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace vitruvia {
namespace {

TEST(OneAhead, MakesAndUsesInOrder) {
  for (const int count : {0, 1, 2, 7}) {
    std::vector<int> made, used;
    MakeOneAhead(
        count,
        [&](int i) {
          made.push_back(i);
          return 10 * i;
        },
        [&](int i, int item) {
          EXPECT_EQ(item, 10 * i);
          used.push_back(i);
        });
    std::vector<int> expected;
    for (int i = 0; i < count; ++i) expected.push_back(i);
    EXPECT_EQ(made, expected);
    EXPECT_EQ(used, expected);
  }
}

// Would never end if one had to wait for the other.
TEST(OneAhead, UsesAnItemWhileTheNextIsMade) {
  std::latch both(2);
  MakeOneAhead(
      2,
      [&](int i) {
        if (i == 1) both.arrive_and_wait();
        return i;
      },
      [&](int i, int) {
        if (i == 0) both.arrive_and_wait();
      });
  EXPECT_TRUE(both.try_wait());
}

TEST(OneAhead, EndsWithAnException) {
  int used = 0;
  const auto make = [](int i) { return i < 3 ? i : throw std::runtime_error("no fourth"); };
  EXPECT_THROW(MakeOneAhead(9, make, [&](int, int) { ++used; }), std::runtime_error);
  EXPECT_EQ(used, 3);
  const auto refuse = [](int i, int) { i < 2 ? void() : throw std::out_of_range("no third use"); };
  EXPECT_THROW(MakeOneAhead(9, make, refuse), std::out_of_range);
}

}  // namespace
}  // namespace vitruvia
