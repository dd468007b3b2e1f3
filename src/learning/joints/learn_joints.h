// Learns a joint model from depth images whose joints are known.
//
// Points are learnt from the pelvis outwards, and each point stage by stage: a stage learns from
// the places that the stages before it reach in images that their trees have not seen. For that
// every tree learns from a share of the images, drawn at random.
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
  double jitter_m = 0.03;
  double reach_m = 0.4;

  void Describe(Fields& fields);
};

struct ForestSettings {
  std::vector<StageSettings> stages{{0.04, 0.6}, {0.04, 0.5}, {0.03, 0.35}, {0.02, 0.2}};
  int trees = 6;
  double image_share = 0.6;
  int starts_per_image = 3;
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
