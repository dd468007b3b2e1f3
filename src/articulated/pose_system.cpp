#include "articulated/pose_system.h"

namespace vitruvia::articulated {
namespace {

// d(direction · x) by the twist of the bone that carries x.
Vector6d Wrench(const Vector3d& x, const Vector3d& direction) {
  Vector6d wrench;
  wrench << x.cross(direction), direction;
  return wrench;
}

}  // namespace

void PoseSystem::AddRow(int bone, const Vector3d& x, const Vector3d& direction, double residual,
                        double weight) {
  const std::array entries{BlockNormalEquations::Entry{bone, Wrench(x, direction)}};
  bones_.AddRow(entries, residual, weight);
}

void PoseSystem::AddPairRow(int bone_a, const Vector3d& a, int bone_b, const Vector3d& b,
                            const Vector3d& direction, double residual, double weight) {
  const std::array entries{BlockNormalEquations::Entry{bone_a, Wrench(a, direction)},
                           BlockNormalEquations::Entry{bone_b, Wrench(b, -direction)}};
  bones_.AddRow(entries, residual, weight);
}

void PoseSystem::AddBlendedRow(std::span<const CarriedPoint> shares, const Vector3d& direction,
                               double residual, double weight) {
  std::array<BlockNormalEquations::Entry, kMaxInfluences> entries;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    entries[k] = {shares[k].bone, shares[k].weight * Wrench(shares[k].place, direction)};
  }
  bones_.AddRow({entries.data(), shares.size()}, residual, weight);
}

void PoseSystem::Reduce(const BoneTwists<double>& twists) {
  stacked_twists_.resize(kBlockSize * kBoneCount, kParameterCount);
  for (int b = 0; b < kBoneCount; ++b) {
    stacked_twists_.middleRows<kBlockSize>(kBlockSize * b) = twists[b];
  }
  bones_.Symmetrize();
  hessian_twists_.noalias() = bones_.hessian() * stacked_twists_;
  hessian_.noalias() = stacked_twists_.transpose() * hessian_twists_;
  gradient_.noalias() = stacked_twists_.transpose() * bones_.gradient();
}

}  // namespace vitruvia::articulated
