#include "methods/dynamic/kinematic_tree.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "math/angles.h"
#include "math/rigid.h"

namespace vitruvia::dynamic {
namespace {

constexpr double kShortestAxis_m = 1e-6;

// Indices into the file's joints, parents before children, otherwise in the file's order.
std::vector<std::size_t> ParentsFirst(const SkeletonFile& file) {
  std::vector<std::size_t> order;
  std::map<std::string, bool> placed{{kWorld, true}};
  while (order.size() < file.joints.size()) {
    const std::size_t before = order.size();
    for (std::size_t i = 0; i < file.joints.size(); ++i) {
      const JointSettings& joint = file.joints[i];
      if (placed[joint.name] || !placed[joint.parent]) continue;
      placed[joint.name] = true;
      order.push_back(i);
    }
    Require(order.size() > before, "skeleton {}: joints that do not hang on the world", file.name);
  }
  return order;
}

Vector3<double> AxisOf(const JointSettings& joint, const Skeleton& subject) {
  Vector3<double> axis(joint.axis[0], joint.axis[1], joint.axis[2]);
  if (!joint.towards.empty()) {
    axis = subject.joints[FindJoint(joint.towards)] - subject.joints[FindJoint(joint.at)];
  }
  Require(axis.norm() > kShortestAxis_m, "joint \"{}\": its axis has no length on this subject",
          joint.name);
  return axis.normalized();
}

DualQuaternion<double> Translation(const Vector3<double>& t) {
  return DualQuaternion<double>::FromRigid({Matrix3<double>::Identity(), t});
}

}  // namespace

DualQuaternion<double> HingeMotion(const Vector3<double>& axis, double angle_rad) {
  DualQuaternion<double> q;
  q.real.w() = std::cos(0.5 * angle_rad);
  q.real.vec() = std::sin(0.5 * angle_rad) * axis;
  return q;
}

DualQuaternion<double> PrismaticMotion(const Vector3<double>& axis, double length_m) {
  DualQuaternion<double> q;
  q.dual.vec() = 0.5 * length_m * axis;
  return q;
}

DualQuaternion<double> Product(const DualQuaternion<double>& c_from_b,
                               const DualQuaternion<double>& b_from_a) {
  DualQuaternion<double> product;
  product.real = c_from_b.real * b_from_a.real;
  product.dual.coeffs() =
      (c_from_b.real * b_from_a.dual).coeffs() + (c_from_b.dual * b_from_a.real).coeffs();
  return product;
}

KinematicTree::KinematicTree(const SkeletonFile& file, const Skeleton& subject) {
  const std::string problem = file.Problem();
  Require(problem.empty(), "skeleton {}: {}", file.name, problem);
  std::map<std::string, int> index{{kWorld, -1}};
  std::vector<int> link_of_bone(kBoneCount, -1);
  for (const std::size_t i : ParentsFirst(file)) {
    const JointSettings& joint = file.joints[i];
    const bool hinge = joint.type == JointType::kHinge;
    const double unit = hinge ? kRadiansPerDegree : 1.0;
    const LimitSettings& limit = hinge ? joint.limit_deg : joint.limit_m;
    if (!joint.bone.empty()) link_of_bone[FindBone(joint.bone)] = joint_count();
    index[joint.name] = joint_count();
    joints_.push_back({joint.name, joint.type, index.at(joint.parent),
                       subject.joints[FindJoint(joint.at)], AxisOf(joint, subject),
                       unit * limit.lower, unit * limit.upper, joint.prior});
  }
  FindChains(link_of_bone);
  links_.resize(joints_.size());
}

// A bone that no joint moves goes with its parent.
void KinematicTree::FindChains(const std::vector<int>& link_of_bone) {
  for (int bone = 0; bone < kBoneCount; ++bone) {
    if (link_of_bone[bone] < 0) {
      chains_[bone] = chains_[Bones()[bone].parent];
      continue;
    }
    for (int joint = link_of_bone[bone]; joint >= 0; joint = joints_[joint].parent) {
      chains_[bone].push_back(joint);
    }
    std::reverse(chains_[bone].begin(), chains_[bone].end());
  }
}

void KinematicTree::Pose(const Rigidd& camera_from_start, const Eigen::VectorXd& theta,
                         TreePose& pose) const {
  Require(theta.size() == joint_count(), "KinematicTree::Pose: {} values for {} joints",
          theta.size(), joint_count());
  pose.twists.resize(joints_.size());
  const auto world = DualQuaternion<double>::FromRigid(camera_from_start);
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    const TreeJoint& joint = joints_[k];
    const bool hangs_on_world = joint.parent < 0;
    const Vector3<double> offset =
        hangs_on_world ? joint.place : Vector3<double>(joint.place - joints_[joint.parent].place);
    const DualQuaternion<double> before =
        Product(hangs_on_world ? world : links_[joint.parent], Translation(offset));
    const Vector3<double> axis = before.real * joint.axis;
    if (joint.type == JointType::kHinge) {
      pose.twists[k] << axis, before.ToRigid().translation.cross(axis);
      links_[k] = Product(before, HingeMotion(joint.axis, theta[static_cast<Eigen::Index>(k)]));
    } else {
      pose.twists[k] << Vector3<double>::Zero(), axis;
      links_[k] = Product(before, PrismaticMotion(joint.axis, theta[static_cast<Eigen::Index>(k)]));
    }
  }
  const int pelvis_link = chains_[static_cast<int>(BoneId::kPelvis)].back();
  pose.twist_origin = links_[pelvis_link].ToRigid().translation;
  for (Twist& twist : pose.twists) {  // until here about the camera's origin
    twist.tail<3>() += twist.head<3>().cross(pose.twist_origin);
  }
  for (int bone = 0; bone < kBoneCount; ++bone) {
    const int link = chains_[bone].back();
    pose.camera_from_rest[bone] = Product(links_[link], Translation(-joints_[link].place));
  }
}

void KinematicTree::Clamp(Eigen::VectorXd& theta) const {
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    double& value = theta[static_cast<Eigen::Index>(k)];
    value = std::clamp(value, joints_[k].lower, joints_[k].upper);
  }
}

}  // namespace vitruvia::dynamic
