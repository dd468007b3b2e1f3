// Learns a joint model from depth images whose joints are known.
#pragma once

#include <vector>

#include "config/settings.h"
#include "learning/joints/joint_model.h"

namespace vitruvia::joints {

struct JointExample {
  CroppedDepth depth;
  Vector3d centroid = Vector3d::Zero();  // of the measured points, camera frame, metres
  BodyPointPositions points;             // camera frame, metres
};

struct StageSettings {
  double start_deviation_m = 0.1;
  double reach_m = 0.4;

  void Describe(Fields& fields);
};

struct ForestSettings {
  std::vector<StageSettings> stages{{0.06, 0.6}, {0.12, 0.45}, {0.06, 0.3}, {0.03, 0.2}};
  int trees = 4;
  int starts_per_example = 4;
  TreeSettings tree;
  int seed = 1;

  void Describe(Fields& fields);
  std::string Problem() const;
};

// All examples are of one camera. The same examples and settings give the same model for any number
// of threads.
JointModel LearnJoints(const std::vector<JointExample>& examples, const PinholeCamera& camera,
                       const ForestSettings& settings, int threads);

}  // namespace vitruvia::joints
