#include "learning/skinning/pose_equations.h"

#include "math/rotation.h"
#include "math/vector.h"

namespace vitruvia::skinning {
namespace {

Matrix3<double> RotationOf(const ConstPose& pose, int bone) {
  return pose.block<3, 3>(4 * bone, 0).transpose();
}

// Rows for bone a's step, columns for bone b's: Σ w_a w_b Jᵀ J with J = [−(R v̄)^ | I].
Matrix6 NormalBlock(const Eigen::Matrix4d& second, const Matrix3<double>& rotation_a,
                    const Matrix3<double>& rotation_b) {
  const Matrix3<double> arms = rotation_b * second.topLeftCorner<3, 3>() * rotation_a.transpose();
  const Vector3<double> centre = second.topRightCorner<3, 1>();
  Matrix6 block;
  block.topLeftCorner<3, 3>() = arms.trace() * Matrix3<double>::Identity() - arms;
  block.topRightCorner<3, 3>() = Skew<double>(rotation_a * centre);
  block.bottomLeftCorner<3, 3>() = -Skew<double>(rotation_b * centre);
  block.bottomRightCorner<3, 3>() = second(3, 3) * Matrix3<double>::Identity();
  return block;
}

}  // namespace

void Differential(const ConstPose& pose, const ConstStep& step, MutablePose change) {
  for (int b = 0; b < pose.rows() / 4; ++b) {
    const Vector3<double> turn = step.segment<3>(6 * b);
    // Rows are axes R e_c: r × R e_c.
    change.block<3, 3>(4 * b, 0).noalias() =
        pose.block<3, 3>(4 * b, 0) * Skew<double>(turn).transpose();
    change.row(4 * b + 3) = step.segment<3>(6 * b + 3).transpose();
  }
}

void Adjoint(const ConstPose& pose, const ConstPose& pull, MutableStep adjoint) {
  for (int b = 0; b < pose.rows() / 4; ++b) {
    // Σ_c R e_c × pull_c, from the antisymmetric part of Σ_c (R e_c) pull_cᵀ.
    const Matrix3<double> outer =
        pose.block<3, 3>(4 * b, 0).transpose() * pull.block<3, 3>(4 * b, 0);
    adjoint.segment<3>(6 * b) << outer(1, 2) - outer(2, 1), outer(2, 0) - outer(0, 2),
        outer(0, 1) - outer(1, 0);
    adjoint.segment<3>(6 * b + 3) = pull.row(4 * b + 3).transpose();
  }
}

void Move(const ConstPose& pose, const ConstStep& step, MutablePose moved) {
  for (int b = 0; b < pose.rows() / 4; ++b) {
    const Matrix3<double> turn = ExpSo3<double>(step.segment<3>(6 * b));
    moved.block<3, 3>(4 * b, 0).noalias() = pose.block<3, 3>(4 * b, 0) * turn.transpose();
    moved.row(4 * b + 3) = pose.row(4 * b + 3) + step.segment<3>(6 * b + 3).transpose();
  }
}

void PoseEquations::Linearise(const BonePattern& pattern, const Eigen::MatrixXd& second,
                              const ConstPose& pose) {
  normal_.resize(pattern.blocks());
  for (int row = 0; row < pattern.bones(); ++row) {
    const int a = pattern.BoneAt(row);
    const Matrix3<double> rotation_a = RotationOf(pose, a);
    for (int column = 0; column <= row; ++column) {
      const int slot = pattern.Slot(row, column), b = pattern.BoneAt(column);
      if (slot < 0) continue;
      if (second(4 * a + 3, 4 * b + 3) > 0.0) {
        normal_[slot] =
            NormalBlock(second.block<4, 4>(4 * a, 4 * b), rotation_a, RotationOf(pose, b));
      } else if (row == column) {
        normal_[slot].setIdentity();
      } else {
        normal_[slot].setZero();
      }
    }
  }
}

bool PoseEquations::Factor(const BonePattern& pattern, double damping) {
  damped_ = normal_;
  for (int place = 0; place < pattern.bones(); ++place) {
    damped_[pattern.Slot(place, place)].diagonal() *= 1.0 + damping;
  }
  return cholesky_.Factor(pattern, damped_);
}

void PoseEquations::Diagonal(const BonePattern& pattern, MutableStep diagonal) const {
  for (int place = 0; place < pattern.bones(); ++place) {
    diagonal.segment<6>(6 * pattern.BoneAt(place)) = normal_[pattern.Slot(place, place)].diagonal();
  }
}

}  // namespace vitruvia::skinning
