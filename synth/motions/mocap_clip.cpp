#include "synth/motions/mocap_clip.h"

namespace vitruvia {

std::vector<Vector3<double>> RestPositions(const MocapClip& clip) {
  std::vector<Vector3<double>> positions;
  positions.reserve(clip.joints.size());
  for (const MocapJoint& joint : clip.joints) {
    Vector3<double> position = Vector3<double>::Zero();
    if (joint.parent >= 0) {
      position = positions[static_cast<std::size_t>(joint.parent)] + joint.offset;
    }
    positions.push_back(position);
  }
  return positions;
}

MocapPose PoseOf(const MocapClip& clip, const MocapFrame& frame) {
  MocapPose pose;
  pose.rotations.reserve(clip.joints.size());
  pose.positions.reserve(clip.joints.size());
  for (std::size_t i = 0; i < clip.joints.size(); ++i) {
    Matrix3<double> rotation = frame.rotations[i].toRotationMatrix();
    Vector3<double> position = frame.root_position;
    if (const int parent = clip.joints[i].parent; parent >= 0) {
      const auto p = static_cast<std::size_t>(parent);
      const Vector3<double>& offset =
          frame.offsets.empty() ? clip.joints[i].offset : frame.offsets[i];
      position = pose.positions[p] + pose.rotations[p] * offset;
      rotation = pose.rotations[p] * rotation;
    }
    pose.rotations.push_back(rotation);
    pose.positions.push_back(position);
  }
  return pose;
}

bool Descends(const MocapClip& clip, int joint, int ancestor) {
  while (joint >= 0 && joint != ancestor)
    joint = clip.joints[static_cast<std::size_t>(joint)].parent;
  return joint >= 0;
}

}  // namespace vitruvia
