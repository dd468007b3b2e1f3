// A second opinion on one solution of normal equations, slow and in double precision.
#pragma once

#include <Eigen/Core>

namespace vitruvia {

struct SystemCheck {
  int weak_directions = 0;  // eigenvalues below 1e-6 of the largest
  double agreeing_digits = 0.0;  // of x with the reference: −log10(‖x − x_ref‖ / ‖x_ref‖), ≤ 16
};

// Of A x = b, A symmetric and finite. The reference solves by A's eigenvectors, and leaves out
// directions whose eigenvalues are not above rounding.
SystemCheck CheckSolution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                          const Eigen::VectorXd& x);

}  // namespace vitruvia
