// Joint accuracy, as reported on Stanford EVAL and in paper A.
#pragma once

#include <vector>

#include "math/vector.h"

namespace vitruvia {

// ‖estimate_j − truth_j‖ in metres; infinite where a coordinate is not finite.
std::vector<double> JointErrors(const std::vector<Vector3<double>>& estimate,
                                const std::vector<Vector3<double>>& truth);

// The same for all frames, after subtracting each joint's mean offset over the frames (estimate
// minus truth, camera frame): for joints that estimate and truth define differently (paper B's
// protocol on EVAL, after Ye and Yang 2014). Joints that are not finite are left out of the mean
// and keep an infinite error. [frame][joint] in and out.
std::vector<std::vector<double>> JointErrorsLessOffset(
    const std::vector<std::vector<Vector3<double>>>& estimates,
    const std::vector<std::vector<Vector3<double>>>& truths);

// Share of the errors that are at most threshold_m; 0 for an empty sample.
double ShareWithin(const std::vector<double>& errors_m, double threshold_m);

// Thresholds 0, step, …, up to and including last, and the share of errors within each.
std::vector<double> Thresholds(double step_m, double last_m);
std::vector<double> AccuracyCurve(const std::vector<double>& errors_m,
                                  const std::vector<double>& thresholds_m);

}  // namespace vitruvia
