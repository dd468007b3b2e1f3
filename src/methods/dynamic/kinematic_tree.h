// The skeleton of dual-quaternion joints, bound to a subject (paper B, sec. 3.1).
//
//   T_k(θ) = T_parent(k) O_k J_k(θ_k), T_world = camera_from_start, bind pose θ = 0.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "body/skeleton.h"
#include "math/dual_quaternion.h"
#include "methods/dynamic/skeleton_file.h"

namespace vitruvia::dynamic {

// (1) hinge: [cos θ/2, a sin θ/2] + ε 0.
DualQuaternion<double> HingeMotion(const Vector3<double>& axis, double angle_rad);
// (2) prismatic: 1 + ε [0, ½ θ a].
DualQuaternion<double> PrismaticMotion(const Vector3<double>& axis, double length_m);
DualQuaternion<double> Product(const DualQuaternion<double>& c_from_b,
                               const DualQuaternion<double>& b_from_a);

struct TreeJoint {
  std::string name;
  JointType type;
  int parent;             // index, smaller than the joint's own; −1: the world
  Vector3<double> place;  // in the bind pose, subject frame, metres
  Vector3<double> axis;   // unit length, bind pose
  double lower, upper;    // rad or m
  double prior;           // factor on the default-pose prior
};

// A motion at unit joint speed, camera frame: angular velocity, and the velocity of the point of
// the moving body that is at the twists' origin o. For a hinge through c about a: (a, (c − o) × a);
// for a prismatic joint along a: (0, a).
using Twist = Eigen::Matrix<double, 6, 1>;

struct TreePose {
  std::array<DualQuaternion<double>, kBoneCount> camera_from_rest;  // B_b = T_k(θ) T_k(0)⁻¹
  // The pelvis joint's position, so that the lever arms of joints are short: with the camera as
  // origin, sums of products of lever arms would lose precision in floats, increasingly with the
  // body's distance.
  Vector3<double> twist_origin;
  std::vector<Twist> twists;  // per joint
};

class KinematicTree {
 public:
  // Joint places are those of the subject's skeleton. std::invalid_argument if an axis that points
  // from one joint of the subject to another has no length.
  KinematicTree(const SkeletonFile& file, const Skeleton& subject);

  const std::vector<TreeJoint>& joints() const { return joints_; }
  int joint_count() const { return static_cast<int>(joints_.size()); }
  // The joints that move a bone, from the world downwards.
  const std::vector<int>& ChainOf(int bone) const { return chains_[bone]; }

  void Pose(const Rigidd& camera_from_start, const Eigen::VectorXd& theta, TreePose& pose) const;
  // Clamps every joint value to its limits.
  void Clamp(Eigen::VectorXd& theta) const;

 private:
  void FindChains(const std::vector<int>& link_of_bone);

  std::vector<TreeJoint> joints_;                      // parents first
  std::array<std::vector<int>, kBoneCount> chains_;    // per bone
  mutable std::vector<DualQuaternion<double>> links_;  // workspace: camera_from_link
};

}  // namespace vitruvia::dynamic
