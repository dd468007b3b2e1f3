#include "methods/realtime_scape/body_pose.h"

#include "math/rotation.h"

namespace vitruvia::realtime_scape {

LocalRotations LocalRotationsOf(const BodyPose& pose) {
  LocalRotations local;
  for (int j = 0; j < kBoneCount; ++j) {
    const int parent = Bones()[j].parent;
    local[j] = pose[j].rotation;
    if (parent >= 0) local[j] = RelativeRotation(pose[parent].rotation, pose[j].rotation);
  }
  return local;
}

double MeanJointAngle(const BodyPose& a, const BodyPose& b) {
  const LocalRotations from = LocalRotationsOf(a), to = LocalRotationsOf(b);
  double sum_rad = 0.0;
  for (int j = 0; j < kBoneCount; ++j) {
    sum_rad += LogSo3<double>(RelativeRotation(from[j], to[j])).norm();
  }
  return sum_rad / kBoneCount;
}

BodyPose Translated(BodyPose pose, const Vector3d& shift) {
  for (BonePose& bone : pose) bone.center += shift;
  return pose;
}

BodyPose RotatedAboutRoot(BodyPose pose, const Matrix3<double>& rotation) {
  const Vector3d pivot = pose.front().center;
  for (BonePose& bone : pose) {
    bone.rotation = rotation * bone.rotation;
    bone.center = pivot + rotation * (bone.center - pivot);
  }
  return pose;
}

}  // namespace vitruvia::realtime_scape
