// How much of each bone the frames confirm, and since when they do not.
#pragma once

#include <array>
#include <vector>

#include "methods/realtime_scape/model.h"
#include "tracking/classification.h"

namespace vitruvia::realtime_scape {

// Vertices by their main bone, in one pose.
struct BoneCounts {
  std::array<int, kBoneCount> visible{}, confirmed{};  // confirmed: V1

  // Whether more than this share of what is visible of a bone is confirmed.
  bool IsWellExplained(int bone, double share) const {
    return confirmed[bone] > share * visible[bone];
  }
};
BoneCounts CountByBone(const Model& model, const std::vector<int>& visible,
                       const VertexClasses& classes);

// For how many frames each bone has not been observed; 0: it was in the last one.
struct BoneVisibility {
  std::array<int, kBoneCount> frames_unobserved{};
};

// After one more frame. A bone is observed when at least `observed_share` of all its vertices is
// confirmed; one without vertices never is.
BoneVisibility Advanced(const BoneVisibility& before, const Model& model, const BoneCounts& counts,
                        double observed_share);

}  // namespace vitruvia::realtime_scape
