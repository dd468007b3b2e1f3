#include "methods/realtime_scape/terms/axis_term.h"

#include "methods/realtime_scape/terms/main_axes.h"
#include "methods/realtime_scape/terms/rotated_vector_row.h"

namespace vitruvia::realtime_scape {

const std::array<MainAxis, 7>& MainAxes() {
  static const std::array<MainAxis, 7> axes{{
      {BoneId::kHead, Vector3<double>::UnitY()},
      {BoneId::kLeftForearm, Vector3<double>::UnitY()},
      {BoneId::kRightForearm, Vector3<double>::UnitY()},
      {BoneId::kLeftShin, Vector3<double>::UnitX()},
      {BoneId::kRightShin, Vector3<double>::UnitX()},
      {BoneId::kLeftFoot, Vector3<double>::UnitX()},
      {BoneId::kRightFoot, Vector3<double>::UnitX()},
  }};
  return axes;
}

void AddAxisTerm(const BodyPose& pose, double weight, BlockNormalEquations& equations) {
  for (const auto& [bone_id, axis] : MainAxes()) {
    const int bone = static_cast<int>(bone_id);
    const int parent = Bones()[bone].parent;
    AddRotatedVectorRows(bone, pose[bone].rotation * axis, parent, pose[parent].rotation * axis,
                         weight, equations);
  }
}

}  // namespace vitruvia::realtime_scape
