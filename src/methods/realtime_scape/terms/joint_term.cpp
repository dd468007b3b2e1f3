#include "methods/realtime_scape/terms/joint_term.h"

#include <Eigen/Eigenvalues>

namespace vitruvia::realtime_scape {
namespace {

using Vector4d = Eigen::Vector4d;
using Matrix4d = Eigen::Matrix4d;

float WeightOf(const Model& model, int vertex, int bone) {
  for (const auto& [b, w] : model.InfluencesOf(vertex)) {
    if (b == bone) return w;
  }
  return 0.0f;
}

// Σ_i w_ij w_il / τ_jl ṽ_i ṽ_iᵀ; of the joint's position where the bones share no vertex.
Matrix4d JointMoment(const Model& model, int bone, int parent) {
  Matrix4d moment = Matrix4d::Zero();
  for (std::size_t i = 0; i < model.rest_vertices.size(); ++i) {
    const int vertex = static_cast<int>(i);
    const double w = double{WeightOf(model, vertex, bone)} * WeightOf(model, vertex, parent);
    if (w == 0.0) continue;
    const Vector4d v = model.rest_vertices[i].cast<double>().homogeneous();
    moment += w * v * v.transpose();
  }
  const double total = moment(3, 3);
  if (total > 0.0) return moment / total;
  const Vector4d joint = model.skeleton.joints[bone].homogeneous();
  return joint * joint.transpose();
}

}  // namespace

JointTerm::JointTerm(const Model& model, JointRows rows) {
  for (int bone = 0; bone < kBoneCount; ++bone) {
    const int parent = Bones()[bone].parent;
    if (parent < 0) continue;
    if (rows == JointRows::kJointPosition) {
      points_.push_back({bone, parent, model.skeleton.joints[bone], 1.0});
      continue;
    }
    const Matrix4d moment = JointMoment(model, bone, parent);
    if (rows == JointRows::kMeanPoint) {
      points_.push_back({bone, parent, moment.col(3).head<3>(), 1.0});
      continue;
    }
    const Eigen::SelfAdjointEigenSolver<Matrix4d> eigen(moment);
    for (int k = 0; k < 4; ++k) {
      const double eigenvalue = eigen.eigenvalues()[k];
      if (eigenvalue <= 0.0) continue;
      const Vector4d point = std::sqrt(eigenvalue) * eigen.eigenvectors().col(k);
      points_.push_back({bone, parent, point.head<3>(), point[3]});
    }
  }
}

void JointTerm::Add(const Model& model, const BodyPose& pose, double weight, double length_unit_m,
                    BlockNormalEquations& equations) const {
  const double per_unit = 1.0 / length_unit_m;
  for (const VirtualPoint& point : points_) {
    // R x + T h about the bone's centre c: R (x − h c̄) + h c.
    const auto arm_of = [&](int bone) -> Vector3d {
      return pose[bone].rotation * (point.x - point.h * model.rest_centers[bone]);
    };
    const Vector3d arm = arm_of(point.bone), parent_arm = arm_of(point.parent);
    const Vector3d gap =
        arm + point.h * pose[point.bone].center - parent_arm - point.h * pose[point.parent].center;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d direction = Vector3d::Unit(axis);
      std::array<BlockNormalEquations::Entry, 2> entries;
      entries[0].block = point.bone;
      entries[0].jacobian << per_unit * arm.cross(direction), point.h * direction;
      entries[1].block = point.parent;
      entries[1].jacobian << -per_unit * parent_arm.cross(direction), -point.h * direction;
      equations.AddRow(entries, per_unit * gap[axis], weight);
    }
  }
}

}  // namespace vitruvia::realtime_scape
