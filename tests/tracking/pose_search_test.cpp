// The parts of relocalisation that know nothing of a method, on poses that are numbers.
#include "tracking/pose_search.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tracking/pose_memory.h"

namespace vitruvia {
namespace {

using Poses = std::vector<double>;

double Difference(const double& a, const double& b) { return std::abs(a - b); }

TEST(PoseMemory, KeepsPosesThatDifferAndReplacesTheOldestButTheFirst) {
  PoseMemory<double> memory(3, 0.5, Difference);
  memory.Remember(0.0);
  memory.Remember(0.4);  // too close
  EXPECT_EQ(memory.poses(), (Poses{0.0}));
  memory.Remember(1.0);
  memory.Remember(2.0);
  memory.Remember(3.0);
  EXPECT_EQ(memory.poses(), (Poses{0.0, 3.0, 2.0}));
  memory.Remember(4.0);
  memory.Remember(5.0);
  EXPECT_EQ(memory.poses(), (Poses{0.0, 5.0, 4.0}));
  PoseMemory<double> of_one(1, 0.5, Difference);
  of_one.Remember(7.0);
  of_one.Remember(8.0);
  EXPECT_EQ(of_one.poses(), (Poses{7.0}));
}

TEST(HypothesisRotations, AreSixteenDifferentRotationsThatKeepTheVerticalAxis) {
  const std::vector<Matrix3<double>> rotations = HypothesisRotations();
  ASSERT_EQ(rotations.size(), 16u);
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    EXPECT_NEAR((rotations[i].transpose() * rotations[i] - Matrix3<double>::Identity()).norm(), 0.0,
                1e-12);
    EXPECT_NEAR(rotations[i].determinant(), 1.0, 1e-12);
    EXPECT_NEAR(std::abs(rotations[i](1, 1)), 1.0, 1e-12);
    for (std::size_t k = 0; k < i; ++k) EXPECT_GT((rotations[i] - rotations[k]).norm(), 0.5);
  }
}

// Truth is at 10. What refining reaches is not what comparing promised.
struct Tester {
  struct Fit {
    double pose;
    Agreement agreement;
  };
  Agreement Compare(double pose) {
    ++compared;
    return {1.0, 1.0 / (1.0 + std::abs(pose - 10.0)), 1.0};
  }
  Fit Refine(double pose) {
    refined.push_back(pose);
    return {pose + 1.0, {1.0, 1.0 / (1.0 + std::abs(pose + 1.0 - 10.0)), 1.0}};
  }
  int compared = 0;
  Poses refined{};
};

TEST(FindBestPose, RefinesTheBestFewAndReturnsTheBestOfThose) {
  Tester tester;
  const Tester::Fit best = FindBestPose(Poses{0.0, 10.5, 9.0, 30.0, 11.0}, 3, tester);
  EXPECT_EQ(tester.compared, 5);
  EXPECT_EQ(tester.refined, (Poses{10.5, 9.0, 11.0}));  // of equal scores the first comes first
  EXPECT_EQ(best.pose, 10.0);
  EXPECT_EQ(best.agreement.confirmed, 1.0);
  EXPECT_EQ(FindBestPose(Poses{3.0}, 3, tester).pose, 4.0);
}

}  // namespace
}  // namespace vitruvia
