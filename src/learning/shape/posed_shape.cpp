#include "learning/shape/posed_shape.h"

#include "core/error.h"
#include "math/rotation.h"

namespace vitruvia {

namespace {

// scan_from_parent of each bone; the identity for the pelvis.
std::array<Matrix3<double>, kBoneCount> ParentRotations(const PosedShape::Parameters& parameters) {
  std::array<Matrix3<double>, kBoneCount> above;
  for (int b = 0; b < kBoneCount; ++b) {
    const int parent = Bones()[b].parent;
    if (parent < 0) {
      above[b].setIdentity();
    } else {
      above[b] = above[parent] * parameters.local_rotations[parent];
    }
  }
  return above;
}

}  // namespace

PosedShape::PosedShape(const ShapeSpace& space, int components)
    : space_(space), components_(components) {
  Require(components >= 1 && components <= space.components(),
          "PosedShape: {} components of a space of {}", components, space.components());
  basis_ = space.basis.leftCols(components);
}

PosedShape::Parameters PosedShape::Start() const {
  Parameters start;
  start.theta = Eigen::VectorXd::Zero(components_);
  start.local_rotations.fill(Matrix3<double>::Identity());
  start.pelvis_position = space_.joint_mean.head<3>();
  return start;
}

PosedShape::Parameters PosedShape::Stepped(const Parameters& parameters,
                                           const Eigen::VectorXd& step) const {
  Parameters stepped = parameters;
  stepped.theta += step.head(components_);
  stepped.pelvis_position += step.segment<3>(components_);
  const std::array<Matrix3<double>, kBoneCount> above = ParentRotations(parameters);
  for (int b = 0; b < kBoneCount; ++b) {
    const Matrix3<double> turn = ExpSo3<double>(step.segment<3>(rotation_index(b)));
    stepped.local_rotations[b] =
        above[b].transpose() * turn * above[b] * parameters.local_rotations[b];
  }
  return stepped;
}

std::array<Vector3d, kBoneCount> PosedShape::BendGradients(const Parameters& parameters) {
  const std::array<Matrix3<double>, kBoneCount> above = ParentRotations(parameters);
  std::array<Vector3d, kBoneCount> gradients;
  for (int b = 0; b < kBoneCount; ++b) {
    gradients[b] = above[b] * LogSo3<double>(parameters.local_rotations[b]);
  }
  return gradients;
}

void PosedShape::Set(const Parameters& parameters) {
  const Eigen::VectorXf theta = parameters.theta.cast<float>();
  const Eigen::VectorXd joints =
      space_.joint_mean + space_.joint_basis.leftCols(components_) * parameters.theta;
  std::array<Vector3d, kBoneCount> posed;
  std::array<Eigen::Matrix3Xd, kBoneCount> posed_by_theta;
  for (int b = 0; b < kBoneCount; ++b) {
    const int parent = Bones()[b].parent;
    const Eigen::Matrix3Xd by_theta = space_.joint_basis.block(3 * b, 0, 3, components_);
    if (parent < 0) {
      rotations_[b] = parameters.local_rotations[b];
      posed[b] = parameters.pelvis_position;
      posed_by_theta[b] = Eigen::Matrix3Xd::Zero(3, components_);
    } else {
      const Matrix3<double>& above = rotations_[parent];
      rotations_[b] = above * parameters.local_rotations[b];
      posed[b] = posed[parent] + above * (joints.segment<3>(3 * b) - joints.segment<3>(3 * parent));
      posed_by_theta[b] =
          posed_by_theta[parent] +
          above * (by_theta - space_.joint_basis.block(3 * parent, 0, 3, components_));
    }
    joints_[b] = joints.segment<3>(3 * b).cast<float>();
    posed_joints_[b] = posed[b].cast<float>();
    float_rotations_[b] = rotations_[b].cast<float>();
    offsets_[b] = (posed_by_theta[b] - rotations_[b] * by_theta).cast<float>();
  }

  const SkinWeights& weights = space_.reference.weights;
  const Eigen::VectorXf flat = space_.mean + basis_ * theta;
  rest_.resize(weights.size());
  vertices_.resize(weights.size());
  for (std::size_t v = 0; v < rest_.size(); ++v) {
    rest_[v] = flat.segment<3>(static_cast<Eigen::Index>(3 * v));
    Vector3f x = Vector3f::Zero();
    for (int k = 0; k < kMaxInfluences && weights.weights[v][k] > 0.0f; ++k) {
      const std::size_t b = weights.bones[v][k];
      x += weights.weights[v][k] *
           (float_rotations_[b] * (rest_[v] - joints_[b]) + posed_joints_[b]);
    }
    vertices_[v] = x;
  }
}

void PosedShape::Row(std::size_t vertex, const Vector3f& n, float* row) const {
  Eigen::Map<Eigen::RowVectorXf> all(row, parameter_count());
  all.setZero();
  auto by_theta = all.head(components_);
  const SkinWeights& weights = space_.reference.weights;
  Vector3f n_in_rest = Vector3f::Zero();
  for (int k = 0; k < kMaxInfluences && weights.weights[vertex][k] > 0.0f; ++k) {
    const float weight = weights.weights[vertex][k];
    const int b = weights.bones[vertex][k];
    n_in_rest += weight * (float_rotations_[b].transpose() * n);
    by_theta.noalias() += (weight * n.transpose()) * offsets_[b];
    const Vector3f x = float_rotations_[b] * (rest_[vertex] - joints_[b]) + posed_joints_[b];
    for (int a = b; a >= 0; a = Bones()[a].parent) {
      all.segment<3>(rotation_index(a)) += weight * (x - posed_joints_[a]).cross(n).transpose();
    }
  }
  by_theta.noalias() +=
      n_in_rest.transpose() * basis_.middleRows<3>(static_cast<Eigen::Index>(3 * vertex));
  all.segment<3>(components_) = n.transpose();
}

}  // namespace vitruvia
