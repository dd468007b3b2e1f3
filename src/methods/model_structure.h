// Structure of the two papers' models, for figures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "body/skeleton.h"

namespace vitruvia {

// Realtime SCAPE: a bone that turns about one axis only (paper A, section 6.1).
struct TurningBone {
  BoneId bone;
  Vector3<double> axis;  // subject frame, rest pose, unit length
};
std::vector<TurningBone> BonesWithMainAxis();

// Dynamic: a joint of its skeleton, bound to a subject (paper B, section 3.1).
enum class ModelJointType { kHinge, kSlide };
struct ModelJoint {
  ModelJointType type;
  int parent;             // index, smaller than the joint's own; -1: the world
  std::string at;         // joint of the subject's skeleton that it sits at
  Vector3<double> place;  // bind pose, subject frame, metres
  Vector3<double> axis;   // bind pose, unit length
};
struct ModelSkeleton {
  std::string name;
  std::vector<ModelJoint> joints;  // parents first
};
// ConfigError naming the file, the joint and what is wrong with it.
ModelSkeleton ReadModelSkeleton(const std::filesystem::path& skeleton_file,
                                const Skeleton& subject);

}  // namespace vitruvia
