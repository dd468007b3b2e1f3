#include "methods/realtime_scape/terms/limit_term.h"

#include <algorithm>

#include "body/bone_limits.h"
#include "methods/realtime_scape/terms/local_rotation_row.h"

namespace vitruvia::realtime_scape {

void AddLimitTerm(const BodyPose& pose, double weight, BlockNormalEquations& equations) {
  for (int bone = 1; bone < kBoneCount; ++bone) {
    const BoneLimits& limits = LimitsOfBones()[bone];
    if (!limits.HasAny()) continue;
    const int parent = Bones()[bone].parent;
    const LocalDeviation deviation(pose, bone, parent, Matrix3<double>::Identity());
    for (int axis = 0; axis < 3; ++axis) {
      const double angle = deviation.vector[axis];
      const double nearest = std::clamp(angle, limits.min_rad[axis], limits.max_rad[axis]);
      if (angle == nearest) continue;
      deviation.AddRow(bone, parent, Vector3d::Unit(axis), nearest, 1.0, weight, equations);
    }
  }
}

}  // namespace vitruvia::realtime_scape
