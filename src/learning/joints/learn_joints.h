// Learns a joint model from depth images whose joints and body parts are known.
#pragma once

#include <vector>

#include "config/settings.h"
#include "learning/joints/joint_model.h"

namespace vitruvia::joints {

// A pixel and the bone of the surface that it shows.
struct LabelledPixel {
  std::uint16_t u, v;
  std::uint8_t bone;
};

struct JointExample {
  CroppedDepth depth;
  std::vector<LabelledPixel> pixels;
  BodyPointPositions points;  // camera frame, metres
};

struct ForestSettings {
  int trees = 3;
  int pixels_per_image = 250;
  TreeSettings tree;
  int seed = 1;

  void Describe(Fields& fields);
};

// All examples must be of one camera. The model does not depend on the number of threads. DataError
// if no example has a labelled pixel with a measurement.
JointModel LearnJoints(const std::vector<JointExample>& examples, const PinholeCamera& camera,
                       const ForestSettings& settings, int threads);

}  // namespace vitruvia::joints
