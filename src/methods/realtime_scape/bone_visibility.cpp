#include "methods/realtime_scape/bone_visibility.h"

namespace vitruvia::realtime_scape {

BoneCounts CountByBone(const Model& model, const std::vector<int>& visible,
                       const VertexClasses& classes) {
  BoneCounts counts;
  for (const int i : visible) ++counts.visible[model.MainBone(i)];
  for (const int i : classes.near_surface) ++counts.confirmed[model.MainBone(i)];
  return counts;
}

BoneVisibility Advanced(const BoneVisibility& before, const Model& model, const BoneCounts& counts,
                        double observed_share) {
  BoneVisibility after;
  for (int j = 0; j < kBoneCount; ++j) {
    const auto vertices = static_cast<double>(model.vertices_of_bone[j].size());
    const bool is_observed =
        counts.confirmed[j] > 0 && counts.confirmed[j] >= observed_share * vertices;
    after.frames_unobserved[j] = is_observed ? 0 : before.frames_unobserved[j] + 1;
  }
  return after;
}

}  // namespace vitruvia::realtime_scape
