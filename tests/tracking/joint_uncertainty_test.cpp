#include "tracking/joint_uncertainty.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace vitruvia {
namespace {

TEST(UnitCovariances, AreBlocksOfTheInverse) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Random(12, 4);
  const Eigen::MatrixXd hessian = rows.transpose() * rows;
  const Eigen::MatrixXd motions = Eigen::MatrixXd::Random(6, 4);
  const Eigen::MatrixXd expected = motions * hessian.inverse() * motions.transpose();
  const std::vector<Matrix3<double>> covariances = UnitCovariances(hessian, motions);
  ASSERT_EQ(covariances.size(), 2u);
  EXPECT_TRUE(covariances[1].isApprox(expected.block<3, 3>(3, 3), 1e-9));
  EXPECT_TRUE(UnitCovariances(-hessian, motions).empty());
}

TEST(ReportUncertainty, ScalesByTheSensorAndFlagsLongAxes) {
  UncertaintySettings settings;
  settings.inflation = 2.0;
  settings.sensor = {0.01, 0.0, 0.0, 0.0};
  settings.model_deviation_m = 0.03;
  settings.unreliable_above_m = 0.04;
  TrackResult result;
  result.outcome = Outcome::kConverged;
  result.joints = {{0, 0, 2}, {0, 0, 2}};
  Matrix3<double> wide = Matrix3<double>::Identity();
  wide(0, 0) = 4.0;
  ReportUncertainty({Matrix3<double>::Identity(), wide}, {}, settings, result);
  EXPECT_NEAR(result.joint_covariances[0](1, 1), 0.02 * 0.02 + 0.03 * 0.03, 1e-12);
  EXPECT_NEAR(result.joint_covariances[1](0, 0), 4 * 0.02 * 0.02 + 0.03 * 0.03, 1e-12);
  EXPECT_EQ(result.unreliable_joints, (std::vector<bool>{false, true}));

  result.outcome = Outcome::kLost;
  ReportUncertainty({Matrix3<double>::Identity(), wide}, {}, settings, result);
  EXPECT_EQ(result.unreliable_joints, (std::vector<bool>{true, true}));
}

TEST(ReportUncertainty, GrowsWhereTheFrameDoesNotSupportABone) {
  UncertaintySettings settings;
  settings.inflation = 1.0;
  settings.unconfirmed_inflation = 2.0;
  settings.sensor = {0.01, 0.0, 0.0, 0.0};
  settings.model_deviation_m = 0.03;
  settings.bend_deviation_m = 0.02;
  settings.disagreement_deviation_m = 0.1;
  settings.lost_deviation_m = 0.2;
  TrackResult result;
  result.outcome = Outcome::kConverged;
  result.joints = {{0, 0, 2}, {0, 0, 2}};
  const std::vector<Matrix3<double>> units(2, Matrix3<double>::Identity());
  const std::vector<JointSupport> supports{{1.0, 0.0, 0.0}, {0.5, 0.4, 2.5}};
  ReportUncertainty(units, supports, settings, result);
  EXPECT_NEAR(result.joint_covariances[0](2, 2), 0.01 * 0.01 + 0.03 * 0.03, 1e-12);
  EXPECT_NEAR(result.joint_covariances[1](2, 2),
              0.02 * 0.02 + 0.03 * 0.03 + 0.04 * 0.04 + 0.05 * 0.05, 1e-12);
  EXPECT_EQ(result.unreliable_joints, (std::vector<bool>{false, true}));
  result.outcome = Outcome::kLost;
  ReportUncertainty(units, supports, settings, result);
  EXPECT_NEAR(result.joint_covariances[0](2, 2), 0.01 * 0.01 + 0.03 * 0.03 + 0.2 * 0.2, 1e-12);
}

TEST(ReportUncertainty, WithoutEquationsNothingIsReliable) {
  UncertaintySettings settings;
  settings.inflation = 1.0;
  TrackResult result;
  result.outcome = Outcome::kConverged;
  result.joints = {{0, 0, 2}};
  ReportUncertainty({}, {}, settings, result);
  EXPECT_TRUE(result.joint_covariances.empty());
  EXPECT_EQ(result.unreliable_joints, (std::vector<bool>{true}));
}

}  // namespace
}  // namespace vitruvia
