#include "methods/realtime_scape/terms/axis_term.h"

#include "methods/realtime_scape/terms/rotated_vector_row.h"

namespace vitruvia::realtime_scape {
namespace {

struct MainAxis {
  BoneId bone;
  Vector3d axis;  // subject frame, rest pose
};

// Guessed (the paper draws one axis and lists the bones): in the T-pose with palms down an elbow
// bends about the vertical, knees and ankles about the left-right axis; a head turns about the
// vertical.
const std::array<MainAxis, 7>& MainAxes() {
  static const std::array<MainAxis, 7> axes{{
      {BoneId::kHead, Vector3d::UnitY()},
      {BoneId::kLeftForearm, Vector3d::UnitY()},
      {BoneId::kRightForearm, Vector3d::UnitY()},
      {BoneId::kLeftShin, Vector3d::UnitX()},
      {BoneId::kRightShin, Vector3d::UnitX()},
      {BoneId::kLeftFoot, Vector3d::UnitX()},
      {BoneId::kRightFoot, Vector3d::UnitX()},
  }};
  return axes;
}

}  // namespace

void AddAxisTerm(const BodyPose& pose, double weight, BlockNormalEquations& equations) {
  for (const auto& [bone_id, axis] : MainAxes()) {
    const int bone = static_cast<int>(bone_id);
    const int parent = Bones()[bone].parent;
    AddRotatedVectorRows(bone, pose[bone].rotation * axis, parent, pose[parent].rotation * axis,
                         weight, equations);
  }
}

}  // namespace vitruvia::realtime_scape
