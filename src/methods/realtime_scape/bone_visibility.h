// How much of each bone a frame confirms, and for how long a bone has not been observed.
#pragma once

#include <array>
#include <vector>

#include "methods/realtime_scape/model.h"
#include "tracking/classification.h"

namespace vitruvia::realtime_scape {

// Vertices by their main bone, in one pose.
struct BoneCounts {
  std::array<int, kBoneCount> visible{}, confirmed{};  // confirmed: V1

  // Whether more than this share of the bone's visible vertices is confirmed.
  bool IsWellExplained(int bone, double share) const {
    return confirmed[bone] > share * visible[bone];
  }
};
BoneCounts CountByBone(const Model& model, const std::vector<int>& visible,
                       const VertexClasses& classes);

// Number of frames for which each bone has not been observed; 0: it was observed in the last frame.
struct BoneVisibility {
  std::array<int, kBoneCount> frames_unobserved{};
};

// Visibility after one more frame. A bone is observed if at least `observed_share` of all its
// vertices is confirmed; a bone without vertices is never observed.
BoneVisibility Advanced(const BoneVisibility& before, const Model& model, const BoneCounts& counts,
                        double observed_share);

}  // namespace vitruvia::realtime_scape
