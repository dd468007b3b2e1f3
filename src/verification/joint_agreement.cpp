#include "verification/joint_agreement.h"

#include <cmath>

#include "verification/limits.h"

namespace vitruvia {
using namespace verification_limits;

void AddFrame(const DepthImage& depth, const PinholeCamera& camera,
              const std::vector<Vector3d>& visible_joints, JointAgreement& sum) {
  for (const Vector3d& joint : visible_joints) {
    ++sum.visible;
    if (!camera.InView(joint)) continue;
    const Eigen::Vector2d pixel = camera.Project(joint);
    const double z =
        depth(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
    if (!(z > 0.0)) continue;
    ++sum.seen;
    sum.ratios.push_back(z / joint.z());
    const double behind_m = joint.z() - z;
    sum.agreeing += behind_m >= -kDepthBehindJoint_m && behind_m <= kJointBehindDepth_m ? 1 : 0;
  }
}

std::vector<Vector3d> VisibleTrueJoints(const JointTruth& truth) {
  std::vector<Vector3d> joints;
  for (std::size_t j = 0; j < truth.positions.size(); ++j) {
    if (truth.Knows(j) && truth.visible[j]) joints.push_back(truth.positions[j]);
  }
  return joints;
}

}  // namespace vitruvia
