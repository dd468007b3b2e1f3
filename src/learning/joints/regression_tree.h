// A regression tree over depth features: from a point near a joint to the offset of the joint.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "config/settings.h"
#include "core/random.h"
#include "learning/joints/depth_feature.h"

namespace vitruvia::joints {

// A point of a training image and where the joint is from it.
struct Sample {
  const CroppedDepth* depth;
  FeaturePoint point;
  Vector3f offset;  // camera frame, metres
};

struct TreeSettings {
  int depth = 12;
  int least_samples = 8;
  int candidates = 80;
  int split_samples = 1000;

  void Describe(Fields& fields);
};

struct RegressionTree {
  struct Node {
    DepthFeature feature;
    float threshold = 0.0f;
    std::int32_t left = -1;           // the right one follows it; −1: a leaf
    std::array<float, 3> offset_m{};  // of a leaf
  };
  std::vector<Node> nodes;  // the root first

  // The mean offset of the training samples that came to the same leaf.
  template <class View>
  Vector3f Offset(const View& view, const FeaturePoint& point) const {
    const Node* node = nodes.data();
    while (node->left >= 0) {
      const bool goes_left = node->feature.Of(view, point) < node->threshold;
      node = nodes.data() + node->left + (goes_left ? 0 : 1);
    }
    return {node->offset_m[0], node->offset_m[1], node->offset_m[2]};
  }
};

// Each split is the one, of candidates drawn at random, that leaves the least squared deviation of
// the offsets from their means. `reach_m`: how far from the point features look. Reorders the
// samples, of which there is one at least.
RegressionTree GrowTree(std::span<Sample> samples, const TreeSettings& settings, double reach_m,
                        RandomStream& random);

}  // namespace vitruvia::joints
