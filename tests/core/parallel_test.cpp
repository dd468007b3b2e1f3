#include "core/parallel.h"

#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vitruvia {
namespace {

using testing::Each;

// For each item the begin of the range that it was in.
std::vector<int> RangesOf(int count, int threads) {
  std::vector<int> begins(static_cast<std::size_t>(count), -1);
  ParallelFor(count, threads, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) begins[static_cast<std::size_t>(i)] = begin;
  });
  return begins;
}

TEST(ParallelFor, CallsEachItemOnce) {
  for (const int count : {0, 1, 2, 31, 32, 33, 1000}) {
    std::vector<int> calls(static_cast<std::size_t>(count), 0);
    ParallelFor(count, 2, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) ++calls[static_cast<std::size_t>(i)];
    });
    EXPECT_THAT(calls, Each(1)) << count;
  }
}

TEST(ParallelFor, RangesDoNotDependOnTheNumberOfThreads) {
  for (const int count : {5, 32, 100, 12345}) {
    const std::vector<int> alone = RangesOf(count, 1);
    EXPECT_EQ(RangesOf(count, 2), alone);
    EXPECT_EQ(RangesOf(count, 7), alone);
  }
}

TEST(ParallelFor, ThrowsWhatTheLowestRangeThrew) {
  for (const int threads : {1, 2, 3}) {
    try {
      ParallelFor(1000, threads, [](int begin, int end) {
        if (begin <= 700 && 700 < end) throw std::runtime_error("late");
        if (begin <= 300 && 300 < end) throw std::runtime_error("early");
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "early");
    }
  }
}

TEST(ParallelFor, RefusesNonsense) {
  EXPECT_THROW(ParallelFor(-1, 1, [](int, int) {}), std::invalid_argument);
  EXPECT_THROW(ParallelFor(1, 0, [](int, int) {}), std::invalid_argument);
}

}  // namespace
}  // namespace vitruvia
