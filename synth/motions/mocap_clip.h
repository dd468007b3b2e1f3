// Motion capture data of a file: a tree of joints and their rotations over time.
//
// All in the axes and the length unit of the file. In the rest pose every joint's rotation is the
// identity, so a rotation is relative to the rest pose.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "math/vector.h"

namespace vitruvia {

struct MocapJoint {
  std::string name;
  int parent = -1;                                   // index, smaller than its own; -1 for the root
  Vector3<double> offset = Vector3<double>::Zero();  // from the parent at rest
  Vector3<double> tip = Vector3<double>::Zero();     // far end of its bone at rest, from the joint
};

struct MocapFrame {
  Vector3<double> root_position = Vector3<double>::Zero();
  std::vector<Eigen::Quaterniond> rotations;  // parent_from_joint, one per joint
  // From the parent in the parent's axes, one per joint (the root's is not used); empty where the
  // joints keep their offsets at rest.
  std::vector<Vector3<double>> offsets;
};

struct MocapClip {
  std::filesystem::path file;  // for messages
  std::vector<MocapJoint> joints;
  double frame_s = 0.0;
  std::vector<MocapFrame> frames;  // at least one
  // Oddities and assumptions of the reader: whole sentences that name the file.
  std::vector<std::string> notes;     // usual cases, not worth a warning
  std::vector<std::string> warnings;  // possible errors
};

// The joints' positions at rest relative to the root.
std::vector<Vector3<double>> RestPositions(const MocapClip& clip);

struct MocapPose {
  std::vector<Matrix3<double>> rotations;  // from the rest pose's axes
  std::vector<Vector3<double>> positions;
};
MocapPose PoseOf(const MocapClip& clip, const MocapFrame& frame);

// The joint or one of its ancestors is `ancestor`.
bool Descends(const MocapClip& clip, int joint, int ancestor);

}  // namespace vitruvia
