// Normal equations of a pose: rows are added in terms of the bones that carry points, and reduced
// to the parameters of MovingBones once.
//
// A row is weight · (residual + Σ direction · δx)², where δx is the motion of a point of the model
// (camera frame, metres). A point on bone b moves by δx = ω × x + v, (ω, v) the bone's twist.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "articulated/moving_bones.h"
#include "body/skinning.h"
#include "solver/block_normal_equations.h"

namespace vitruvia::articulated {

// One bone's share of a point that is skinned to several bones: the place where this bone alone
// would put the point.
struct CarriedPoint {
  int bone;
  double weight;
  Vector3d place;  // camera frame, metres
};

class PoseSystem {
 public:
  void Reset() { bones_.Reset(); }

  // Row of a point that moves rigidly with one bone.
  void AddRow(int bone, const Vector3d& x, const Vector3d& direction, double residual,
              double weight);
  // Row of the distance a − b of two points along `direction`.
  void AddPairRow(int bone_a, const Vector3d& a, int bone_b, const Vector3d& b,
                  const Vector3d& direction, double residual, double weight);
  // Row of a point x = Σ weight · place (linear blend skinning). `shares` must not contain a bone
  // twice.
  void AddBlendedRow(std::span<const CarriedPoint> shares, const Vector3d& direction,
                     double residual, double weight);

  // After the last row: H and g of Σ = δᵀHδ + 2gᵀδ + energy in the parameters of the bones.
  void Reduce(const BoneTwists<double>& twists);
  const Eigen::MatrixXd& hessian() const { return hessian_; }
  const Eigen::VectorXd& gradient() const { return gradient_; }
  double energy() const { return bones_.energy(); }

 private:
  BlockNormalEquations bones_{kBoneCount};
  Eigen::MatrixXd stacked_twists_, hessian_twists_, hessian_;
  Eigen::VectorXd gradient_;
};

}  // namespace vitruvia::articulated
