#include "methods/realtime_scape/terms/limit_term.h"

#include "body/bone_limits.h"
#include "methods/realtime_scape/terms/local_rotation_row.h"

namespace vitruvia::realtime_scape {
namespace {

// Of the angles' parts beyond the range, zero within it.
Vector3d Excess(const Vector3d& angles, const BoneLimits& limits, double slack_rad) {
  const Vector3d slack = Vector3d::Constant(slack_rad);
  return angles - angles.cwiseMax(limits.min_rad - slack).cwiseMin(limits.max_rad + slack);
}

}  // namespace

void AddLimitTerm(const BodyPose& pose, double slack_rad, double weight,
                  BlockNormalEquations& equations) {
  for (int bone = 1; bone < kBoneCount; ++bone) {
    const BoneLimits& limits = LimitsOfBones()[bone];
    if (!limits.HasAny()) continue;
    const LocalDeviation deviation(pose, bone, Bones()[bone].parent, Matrix3<double>::Identity());
    // A bent and turned elbow may have a rotation angle beyond π. Of the two rotation vectors of
    // the rotation, the one nearer to the range is used.
    Vector3d angles = deviation.vector();
    Vector3d excess = Excess(angles, limits, slack_rad);
    const Vector3d other_angles = OtherWayRound(angles);
    const Vector3d other_excess = Excess(other_angles, limits, slack_rad);
    if (other_excess.squaredNorm() < excess.squaredNorm()) {
      angles = other_angles;
      excess = other_excess;
    }
    const Vector3d is_beyond = (excess.array() != 0.0).cast<double>();
    deviation.AddRows(angles, angles - excess, is_beyond, weight, equations);
  }
}

}  // namespace vitruvia::realtime_scape
