#include "sequence/joint_visibility.h"

#include "body/skeleton.h"

namespace vitruvia {

double JointBelowSkin(int bone) {
  for (const BoneId trunk : {BoneId::kPelvis, BoneId::kAbdomen, BoneId::kChest}) {
    if (bone == static_cast<int>(trunk)) return kTrunkJointBelowSkinM;
  }
  return kLimbJointBelowSkinM;
}

bool SeesJoint(const Vector3<double>& joint_in_camera, double below_skin_m, const DepthImage& depth,
               const PinholeCamera& camera) {
  const auto pixel = camera.PixelOf(joint_in_camera);
  if (!pixel) return false;
  const float skin = depth(pixel->u, pixel->v);
  return skin == 0.0f || joint_in_camera.z() - skin <= below_skin_m;
}

std::vector<bool> VisibleJoints(const std::vector<Vector3<double>>& joints_in_camera,
                                const DepthImage& depth, const PinholeCamera& camera) {
  std::vector<bool> visible;
  for (std::size_t i = 0; i < joints_in_camera.size(); ++i) {
    visible.push_back(
        SeesJoint(joints_in_camera[i], JointBelowSkin(static_cast<int>(i)), depth, camera));
  }
  return visible;
}

}  // namespace vitruvia
