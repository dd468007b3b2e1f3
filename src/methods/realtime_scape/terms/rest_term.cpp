#include "methods/realtime_scape/terms/rest_term.h"

#include "methods/realtime_scape/terms/local_rotation_row.h"

namespace vitruvia::realtime_scape {

void AddRestTerm(const BodyPose& pose, double weight, BlockNormalEquations& equations) {
  for (int bone = 1; bone < kBoneCount; ++bone) {
    const LocalDeviation deviation(pose, bone, Bones()[bone].parent, Matrix3<double>::Identity());
    deviation.AddRows(deviation.vector(), Vector3d::Zero(), Vector3d::Ones(), weight, equations);
  }
}

}  // namespace vitruvia::realtime_scape
