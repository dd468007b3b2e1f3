#include "metrics/joint_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace vitruvia {

std::vector<double> JointErrors(const std::vector<Vector3<double>>& estimate,
                                const std::vector<Vector3<double>>& truth) {
  Require(estimate.size() == truth.size(), "JointErrors: {} estimated and {} true joints",
          estimate.size(), truth.size());
  std::vector<double> errors(estimate.size());
  for (std::size_t j = 0; j < estimate.size(); ++j) {
    const double distance = (estimate[j] - truth[j]).norm();
    errors[j] = std::isfinite(distance) ? distance : std::numeric_limits<double>::infinity();
  }
  return errors;
}

std::vector<std::vector<double>> JointErrorsLessOffset(
    const std::vector<std::vector<Vector3<double>>>& estimates,
    const std::vector<std::vector<Vector3<double>>>& truths) {
  Require(estimates.size() == truths.size(),
          "JointErrorsLessOffset: {} estimated and {} true frames", estimates.size(),
          truths.size());
  if (estimates.empty()) return {};
  const std::size_t joints = estimates.front().size();
  std::vector<Vector3<double>> sums(joints, Vector3<double>::Zero());
  std::vector<int> counts(joints, 0);
  for (std::size_t f = 0; f < estimates.size(); ++f) {
    Require(estimates[f].size() == joints && truths[f].size() == joints,
            "JointErrorsLessOffset: frame {} has {} estimated and {} true joints, the first has {}",
            f, estimates[f].size(), truths[f].size(), joints);
    for (std::size_t j = 0; j < joints; ++j) {
      const Vector3<double> offset = estimates[f][j] - truths[f][j];
      if (!offset.allFinite()) continue;
      sums[j] += offset;
      ++counts[j];
    }
  }
  std::vector<std::vector<double>> errors;
  for (std::size_t f = 0; f < estimates.size(); ++f) {
    std::vector<Vector3<double>> aligned = estimates[f];
    for (std::size_t j = 0; j < joints; ++j) aligned[j] -= sums[j] / std::max(counts[j], 1);
    errors.push_back(JointErrors(aligned, truths[f]));
  }
  return errors;
}

double ShareWithin(const std::vector<double>& errors_m, double threshold_m) {
  if (errors_m.empty()) return 0.0;
  const auto within = std::count_if(errors_m.begin(), errors_m.end(),
                                    [&](double error) { return error <= threshold_m; });
  return static_cast<double>(within) / static_cast<double>(errors_m.size());
}

std::vector<double> Thresholds(double step_m, double last_m) {
  Require(step_m > 0.0 && last_m >= 0.0, "Thresholds: step {} and last {} make no range", step_m,
          last_m);
  std::vector<double> thresholds;
  const auto count = static_cast<int>(std::lround(last_m / step_m));
  for (int i = 0; i <= count; ++i) thresholds.push_back(step_m * i);
  return thresholds;
}

std::vector<double> AccuracyCurve(const std::vector<double>& errors_m,
                                  const std::vector<double>& thresholds_m) {
  std::vector<double> shares;
  for (const double threshold : thresholds_m) shares.push_back(ShareWithin(errors_m, threshold));
  return shares;
}

}  // namespace vitruvia
