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

// All lengths are divided by the person's size (SizeOf).
struct JointExample {
  CroppedDepth depth;
  std::vector<LabelledPixel> pixels;
  BodyPointPositions points;  // camera frame, metres
};

struct WalkSettings {
  int trees = 3;             // of each point
  int starts_per_image = 3;  // of each point and tree
  double deviation_m = 0.06;
  TreeSettings tree{.least_pixels = 8, .candidates = 100, .split_pixels = 800, .reach_m = 0.4};

  void Describe(Fields& fields);
};

struct ForestSettings {
  int trees = 2;
  int pixels_per_image = 90;
  TreeSettings tree;
  WalkSettings walks;
  int seed = 1;

  void Describe(Fields& fields);
};

// All examples must be of one camera. The model does not depend on the number of threads. DataError
// if no example has a labelled pixel with a measurement.
JointModel LearnJoints(const std::vector<JointExample>& examples, const PinholeCamera& camera,
                       const ForestSettings& settings, int threads);

}  // namespace vitruvia::joints
