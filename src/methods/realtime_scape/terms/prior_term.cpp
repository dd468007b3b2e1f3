#include "methods/realtime_scape/terms/prior_term.h"

#include "body/pose_statistics.h"
#include "methods/realtime_scape/terms/local_rotation_row.h"

namespace vitruvia::realtime_scape {

void AddPriorTerm(const BodyPose& pose, double weight, BlockNormalEquations& equations) {
  for (int bone = 1; bone < kBoneCount; ++bone) {
    const int parent = Bones()[bone].parent;
    const LocalRotationStatistics& usual = CapturedPoseStatistics()[bone];
    const LocalDeviation deviation(pose, bone, parent, usual.mean);
    for (int axis = 0; axis < 3; ++axis) {
      deviation.AddRow(bone, parent, Vector3d::Unit(axis), 0.0, 1.0 / usual.deviation_rad[axis],
                       weight, equations);
    }
  }
}

}  // namespace vitruvia::realtime_scape
