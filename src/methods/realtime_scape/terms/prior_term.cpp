#include "methods/realtime_scape/terms/prior_term.h"

#include "body/pose_statistics.h"
#include "methods/realtime_scape/terms/local_rotation_row.h"

namespace vitruvia::realtime_scape {

void AddPriorTerm(const BodyPose& pose, double weight, BlockNormalEquations& equations) {
  for (int bone = 1; bone < kBoneCount; ++bone) {
    const int parent = Bones()[bone].parent;
    const LocalRotationStatistics& usual = CapturedPoseStatistics()[bone];
    const LocalDeviation deviation(pose, bone, parent, usual.mean);
    deviation.AddRows(deviation.vector(), Vector3d::Zero(), usual.deviation_rad.cwiseInverse(),
                      weight, equations);
  }
}

}  // namespace vitruvia::realtime_scape
