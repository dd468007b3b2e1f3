// A stand-in for a joint detector: true joints with stated noise. It detects hidden joints as well
// as visible ones and does not use the surface; results that depend on it must say so.
#pragma once

#include <string>
#include <vector>

#include "config/settings.h"
#include "geometry/mesh.h"

namespace vitruvia {

// The noise model that Wang, Kurillo, Ofli & Bajcsy, "Evaluation of pose tracking accuracy in the
// first and second generations of Microsoft Kinect", ICHI 2015, fit to a Kinect's joints: a
// Gaussian with a bias, mixed with a rare uniform distribution.
struct JointStandInSettings {
  double deviation_m = 0.01;
  double depth_bias_m = 0.0;
  double outlier_share = 0.01;
  double outlier_reach_m = 0.2;
  int seed = 1;

  void Describe(Fields& fields);
};

// The noise in words.
std::string StandInDescription(const JointStandInSettings& settings);

// Of one frame, camera frame, metres; NaN for joints whose position is not known.
std::vector<Vector3d> StandInJoints(const JointStandInSettings& settings,
                                    const std::vector<Vector3d>& true_joints,
                                    const std::vector<bool>& known, int frame);

}  // namespace vitruvia
