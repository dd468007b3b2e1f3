#include "math/statistics.h"

#include <cmath>

#include <gtest/gtest.h>

namespace vitruvia {
namespace {

using Sample = std::vector<double>;

TEST(RankCorrelation, DependsOnTheOrderAlone) {
  EXPECT_DOUBLE_EQ(RankCorrelation(Sample{1, 2, 3, 4}, Sample{1, 8, 27, 64}), 1.0);
  EXPECT_DOUBLE_EQ(RankCorrelation(Sample{1, 2, 3, 4}, Sample{5, 3, 2, -7}), -1.0);
  // 1 − 6 Σ d² / (n (n² − 1)) with d = (0, 1, −1, 0, 0).
  EXPECT_DOUBLE_EQ(RankCorrelation(Sample{1, 2, 3, 4, 5}, Sample{10, 30, 20, 40, 50}),
                   1.0 - 6.0 * 2.0 / (5.0 * 24.0));
}

TEST(RankCorrelation, EqualValuesShareTheirMeanRank) {
  // Ranks (1, 2.5, 2.5, 4) and (1, 2, 3, 4): 4.5 / sqrt(4.5 · 5).
  EXPECT_DOUBLE_EQ(RankCorrelation(Sample{1, 2, 2, 3}, Sample{1, 2, 3, 4}),
                   4.5 / std::sqrt(4.5 * 5.0));
}

TEST(RankCorrelation, IsAbsentWhereItMeansNothing) {
  EXPECT_TRUE(std::isnan(RankCorrelation(Sample{1, 2}, Sample{1, 2})));
  EXPECT_TRUE(std::isnan(RankCorrelation(Sample{1, 1, 1}, Sample{1, 2, 3})));
}

}  // namespace
}  // namespace vitruvia
