// A slow check, in double precision, of one solution of normal equations.
#pragma once

#include <Eigen/Core>

namespace vitruvia {

struct SystemCheck {
  int weak_directions = 0;       // eigenvalues below 1e-6 of the largest
  double agreeing_digits = 0.0;  // of x: −log10(‖x − x_ref‖ / ‖x_ref‖), ≤ 16
};

// Checks a solution x of A x = b, A symmetric and finite. The reference solution is computed from
// A's eigenvectors, without the directions whose eigenvalues are at rounding level.
SystemCheck CheckSolution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                          const Eigen::VectorXd& x);

}  // namespace vitruvia
