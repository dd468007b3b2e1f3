#include "solver/system_check.h"

#include <gtest/gtest.h>

namespace vitruvia {
namespace {

TEST(SystemCheck, CountsWeakDirectionsAndDigits) {
  const Eigen::Vector4d values(1.0, 0.5, 1e-7, 1e-3);
  const Eigen::MatrixXd a = values.asDiagonal();
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(4);
  const Eigen::VectorXd exact = b.cwiseQuotient(Eigen::VectorXd(values));
  EXPECT_EQ(CheckSolution(a, b, exact).weak_directions, 1);
  EXPECT_GT(CheckSolution(a, b, exact).agreeing_digits, 14.0);
  EXPECT_NEAR(CheckSolution(a, b, exact * (1.0 + 1e-5)).agreeing_digits, 5.0, 1e-6);
}

}  // namespace
}  // namespace vitruvia
