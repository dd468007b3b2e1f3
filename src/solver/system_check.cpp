#include "solver/system_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

namespace vitruvia {

SystemCheck CheckSolution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                          const Eigen::VectorXd& x) {
  constexpr double kWeakBelow = 1e-6, kMostDigits = 16.0;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(a);
  const Eigen::VectorXd& values = spectrum.eigenvalues();
  const double largest = values.cwiseAbs().maxCoeff();
  const double rounding =
      static_cast<double>(a.rows()) * std::numeric_limits<double>::epsilon() * largest;
  Eigen::VectorXd along = spectrum.eigenvectors().transpose() * b;
  for (Eigen::Index i = 0; i < along.size(); ++i)
    along[i] = values[i] > rounding ? along[i] / values[i] : 0.0;
  const Eigen::VectorXd reference = spectrum.eigenvectors() * along;
  const double difference = (x - reference).norm() / reference.norm();
  return {static_cast<int>((values.array() < kWeakBelow * largest).count()),
          difference > 0.0 ? std::min(-std::log10(difference), kMostDigits) : kMostDigits};
}

}  // namespace vitruvia
