// Joint accuracy, as Stanford EVAL and paper A report it.
#pragma once

#include <vector>

#include "math/vector.h"

namespace vitruvia {

// ‖estimate_j − truth_j‖ in metres; infinite where a coordinate is not finite.
std::vector<double> JointErrors(const std::vector<Vector3<double>>& estimate,
                                const std::vector<Vector3<double>>& truth);

// The same for all frames at once, after the mean offset of each joint over the frames, estimate
// minus truth in the camera frame, is taken off: for joints that are defined differently on both
// sides (paper B's protocol on EVAL, after Ye and Yang 2014). Joints that are not finite do not
// count in the mean, and stay infinitely far. [frame][joint] in and out.
std::vector<std::vector<double>> JointErrorsLessOffset(
    const std::vector<std::vector<Vector3<double>>>& estimates,
    const std::vector<std::vector<Vector3<double>>>& truths);

// Share of the errors that are at most threshold_m; 0 of an empty sample.
double ShareWithin(const std::vector<double>& errors_m, double threshold_m);

// The share over a whole range of thresholds: 0, step, …, up to and including last.
std::vector<double> Thresholds(double step_m, double last_m);
std::vector<double> AccuracyCurve(const std::vector<double>& errors_m,
                                  const std::vector<double>& thresholds_m);

}  // namespace vitruvia
