// A decision tree over depth features that maps a place on a body to votes for the positions of
// joints.
//
// The splits of a voting tree separate the body parts that pixels show (Shotton et al. 2011); its
// leaves hold the mean offsets of the points with the least variance among the leaf's training
// pixels (Girshick et al. 2011). The splits of a walk tree reduce the variance of the offset to one
// point, from places round that point; a walk goes from place to place by the offsets of its leaves
// (Jung et al. 2015).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "body/body_points.h"
#include "config/settings.h"
#include "core/random.h"
#include "learning/joints/depth_feature.h"

namespace vitruvia::joints {

// A place in a training image, on the surface or within the body: the part that it shows, and the
// true points.
struct TrainingPixel {
  const CroppedDepth* depth;
  FeaturePoint place;
  Vector3f position;  // camera frame, metres
  int bone;
  const BodyPointPositions* points;
};

inline constexpr int kLeafVotes = 6;

struct PointVote {
  std::int32_t point = -1;          // −1: no vote
  float deviation_m = 0.0f;         // root mean square deviation of the training pixels' offsets
  std::array<float, 3> offset_m{};  // from the pixel's position to the point
};

struct TreeSettings {
  int depth = 18;
  int least_pixels = 20;
  int candidates = 80;
  int split_pixels = 1000;
  double reach_m = 0.5;

  void Describe(Fields& fields);
};

struct VotingTree {
  struct Node {
    DepthFeature feature;
    float threshold = 0.0f;
    std::int32_t left = -1;  // index of the left child, followed by the right one; −1: a leaf
    std::int32_t leaf = -1;  // of a leaf
  };
  using Leaf = std::array<PointVote, kLeafVotes>;

  std::vector<Node> nodes;  // the root first
  std::vector<Leaf> leaves;

  template <class View>
  const Leaf& LeafOf(const View& view, const FeaturePoint& place) const {
    const Node* node = nodes.data();
    while (node->left >= 0) {
      const bool goes_left = node->feature.Of(view, place) < node->threshold;
      node = nodes.data() + node->left + (goes_left ? 0 : 1);
    }
    return leaves[static_cast<std::size_t>(node->leaf)];
  }
};

// Each split is the one of randomly drawn candidates with the least entropy of the parts. Reorders
// the pixels (at least one).
VotingTree GrowTree(std::span<TrainingPixel> pixels, const TreeSettings& settings,
                    RandomStream& random);

// The same, but each split leaves the least sum of squares of the offsets to the point, and leaves
// vote for it alone.
VotingTree GrowWalkTree(std::span<TrainingPixel> pixels, int point, const TreeSettings& settings,
                        RandomStream& random);

}  // namespace vitruvia::joints
