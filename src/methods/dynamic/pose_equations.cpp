#include "methods/dynamic/pose_equations.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "math/rigid.h"
#include "methods/dynamic/blend.h"
#include "solver/lane_rows.h"

namespace vitruvia::dynamic {
namespace {

// The six derivatives of n·v after a link's (φ, τ), written to row[0 … 5]. v, t and the dual
// quaternions are about the twists' origin.
//
// With b = q_r + ε q_d the blend, n² = |q_r|², and c = w/n² q_k q_r*, f = w/n² d_k q_r* of a link's
// q̂_k = q_k + ε d_k, both as scalar and vector:
//   ∂(n·v)/∂τ = c₀ n + c × n
//   ∂(n·v)/∂φ = ½ (c₀ h + c × h + κ c) + f₀ n + f × n
// where h = (2v − t) × n − 2σ n, κ = n·t, t the blend's translation and σ the scalar part of
// q_d q_r*/n². It is the derivative of v = (q_r v̄ q_r* + 2 vec(q_d q_r*)) / n², division included.
template <class Scalar>
struct LinkRow {
  const LaneBlend<Scalar>& blend;
  LaneVector<Scalar> n, h;
  Lanes<Scalar> kappa;

  LinkRow(const LaneBlend<Scalar>& b, const LaneVector<Scalar>& v, const LaneVector<Scalar>& normal)
      : blend(b), n(normal) {
    const LaneVector<Scalar> t = b.Translation();
    const Lanes<Scalar> twice_excess = Scalar(2) * b.Excess();
    const LaneVector<Scalar> lever = {Scalar(2) * v.x - t.x, Scalar(2) * v.y - t.y,
                                      Scalar(2) * v.z - t.z};
    h = Cross(lever, n);
    h.x -= twice_excess * n.x;
    h.y -= twice_excess * n.y;
    h.z -= twice_excess * n.z;
    kappa = Dot(n, t);
  }

  // scale · q q_r* as scalar and vector, q a constant.
  void TimesConjugate(const Eigen::Quaternion<Scalar>& q, const Lanes<Scalar>& scale,
                      Lanes<Scalar>& scalar, LaneVector<Scalar>& vector) const {
    const auto& [a, b, u, d, inverse_square] = blend;
    scalar = scale * (q.w() * a + q.x() * u.x + q.y() * u.y + q.z() * u.z);
    vector.x = scale * (q.x() * a - q.w() * u.x + u.y * q.z() - u.z * q.y());
    vector.y = scale * (q.y() * a - q.w() * u.y + u.z * q.x() - u.x * q.z());
    vector.z = scale * (q.z() * a - q.w() * u.z + u.x * q.y() - u.y * q.x());
  }

  void Write(const DualQuaternion<Scalar>& q, const Lanes<Scalar>& weight,
             Lanes<Scalar>* row) const {
    const Lanes<Scalar> scale = weight * blend.inverse_square;
    Lanes<Scalar> c0, f0;
    LaneVector<Scalar> c, f;
    TimesConjugate(q.real, scale, c0, c);
    TimesConjugate(q.dual, scale, f0, f);
    const LaneVector<Scalar> c_h = Cross(c, h), f_n = Cross(f, n), c_n = Cross(c, n);
    const Scalar half(0.5);
    row[0] = half * (c0 * h.x + c_h.x + kappa * c.x) + f0 * n.x + f_n.x;
    row[1] = half * (c0 * h.y + c_h.y + kappa * c.y) + f0 * n.y + f_n.y;
    row[2] = half * (c0 * h.z + c_h.z + kappa * c.z) + f0 * n.z + f_n.z;
    row[3] = c0 * n.x + c_n.x;
    row[4] = c0 * n.y + c_n.y;
    row[5] = c0 * n.z + c_n.z;
  }
};

// The observed slots of a patch, row by row in full lanes. A slot stays in its lane and in its
// order there, so each lane adds up the same numbers in the same order as without packing.
struct PackedSlots {
  std::array<SlotLanes, kMaxPatchSlots / kLanes> slots;
  IntLanes count_of_lane{};  // rows below it hold an observed slot, rows from it on any slot
  int rows = 0;

  PackedSlots(const Patch& patch, const std::vector<std::uint8_t>& observed) {
    SlotLanes counts{};
    for (int first = patch.begin; first < patch.end; first += kLanes) {
      for (unsigned bits = observed[first / kLanes]; bits != 0; bits &= bits - 1) {
        const int lane = std::countr_zero(bits);
        slots[counts[lane]++][lane] = first + lane;
      }
    }
    rows = *std::max_element(counts.begin(), counts.end());
    for (int lane = 0; lane < kLanes; ++lane) {
      count_of_lane[lane] = counts[lane];
      for (int row = counts[lane]; row < rows; ++row) slots[row][lane] = patch.begin + lane;
    }
  }
};

// Means of the points of eight slots, 0 in lanes that are off, and 1 in those that are on.
template <class Scalar>
struct LaneMeans {
  LaneVector<Scalar> mean;
  Lanes<Scalar> mask;
};
template <class Scalar>
[[gnu::always_inline]] inline LaneMeans<Scalar> MeansOf(const Observations<Scalar>& observations,
                                                        const SlotLanes& slots,
                                                        const IntLanes& is_on) {
  LaneVector<Scalar> sum{};
  Lanes<Scalar> count{}, mask{};
  for (int lane = 0; lane < kLanes; ++lane) {
    const Scalar* s = &observations.sums[4 * static_cast<std::size_t>(slots[lane])];
    sum.x[lane] = s[0];
    sum.y[lane] = s[1];
    sum.z[lane] = s[2];
    count[lane] = is_on[lane] != 0 ? s[3] : Scalar(1);
    mask[lane] = is_on[lane] != 0 ? Scalar(1) : Scalar(0);
  }
  const Lanes<Scalar> inverse_count = Scalar(1) / count;
  return {{sum.x * inverse_count, sum.y * inverse_count, sum.z * inverse_count}, mask};
}

}  // namespace

template <class Scalar>
LinkMotions<Scalar> LinkMotionsOf(const TreePose& pose) {
  const auto origin_from_camera =
      DualQuaternion<double>::FromRigid({Matrix3<double>::Identity(), -pose.twist_origin});
  LinkMotions<Scalar> motions;
  motions.origin = pose.twist_origin.template cast<Scalar>();
  for (int b = 0; b < kBoneCount; ++b) {
    const DualQuaternion<double> bone = Product(origin_from_camera, pose.camera_from_rest[b]);
    motions.origin_from_rest[b] = {bone.real.cast<Scalar>(), bone.dual.cast<Scalar>()};
  }
  return motions;
}

template <class Scalar>
LinkEquations<Scalar>::LinkEquations(const SurfaceLayout& layout)
    : sums_(layout.patches.size()), links_(kBoneCount) {}

template <class Scalar>
template <int N>
void LinkEquations<Scalar>::AddLanes(const Patch& patch, const Surface<Scalar>& s,
                                     const LinkMotions<Scalar>& motions,
                                     const Observations<Scalar>& observations,
                                     PatchSums& sums) const {
  using Lane = Lanes<Scalar>;
  LaneRows<N, Scalar> rows;
  typename LaneRows<N, Scalar>::Row row;
  const PackedSlots packed(patch, observations.observed);
  const auto q = InOneHemisphere(patch, motions.origin_from_rest);
  for (int i = 0; i < packed.rows; ++i) {
    const SlotLanes& slots = packed.slots[i];
    const auto [mean, mask] = MeansOf(observations, slots, packed.count_of_lane > i);
    const auto blend = LaneBlend<Scalar>::template Of<N>(q, s.weights, slots);
    const auto v = LaneVector<Scalar>::Load(s.posed, slots);
    auto n = LaneVector<Scalar>::Load(s.normals, slots);
    // Vertices that no point chose have no residual: a normal of zero makes r and its row zero.
    n.x *= mask;
    n.y *= mask;
    n.z *= mask;
    const Lane r = Dot(n, {v.x - mean.x, v.y - mean.y, v.z - mean.z});  // eq. 6
    const LaneVector<Scalar> lever = {v.x - motions.origin.x(), v.y - motions.origin.y(),
                                      v.z - motions.origin.z()};
    const LinkRow<Scalar> link_row(blend, lever, n);
    for (int k = 0; k < N; ++k)
      link_row.Write(q[k], Load<Scalar>(s.weights[k], slots), &row[kTwistSize * k]);
    rows.Add(row, r, row, r);
  }
  sums.rows = rows.Sums();
  sums.residuals = SumOfLanes(packed.count_of_lane);
}

template <class Scalar>
void LinkEquations<Scalar>::AddPatch(int patch, const Surface<Scalar>& surface,
                                     const LinkMotions<Scalar>& motions,
                                     const Observations<Scalar>& observations) {
  const Patch& p = surface.layout.patches[patch];
  PatchSums& sums = sums_[patch];
  switch (p.influences) {
    case 1:
      return AddLanes<1>(p, surface, motions, observations, sums);
    case 2:
      return AddLanes<2>(p, surface, motions, observations, sums);
    case 3:
      return AddLanes<3>(p, surface, motions, observations, sums);
    default:
      return AddLanes<4>(p, surface, motions, observations, sums);
  }
}

template <class Scalar>
void LinkEquations<Scalar>::ReduceToJoints(const SurfaceLayout& layout, const KinematicTree& tree,
                                           const TreePose& pose, PoseEquations& equations) {
  links_.Reset();
  equations.residuals = 0;
  equations.observed.fill(0);
  for (std::size_t i = 0; i < layout.patches.size(); ++i) {
    const Patch& patch = layout.patches[i];
    const PatchSums& sums = sums_[i];
    if (sums.residuals == 0) continue;
    links_.AddRows({patch.bones.data(), static_cast<std::size_t>(patch.influences)}, sums.rows);
    equations.residuals += sums.residuals;
    equations.observed[patch.bones[0]] += sums.residuals;
  }
  links_.Symmetrize();
  equations.energy = links_.energy();
  // S: a joint moves every bone down its chain by one and the same twist.
  twists_.setZero(kLinkUnknowns, tree.joint_count());
  for (int bone = 0; bone < kBoneCount; ++bone) {
    for (const int joint : tree.ChainOf(bone)) {
      twists_.block<kTwistSize, 1>(kTwistSize * bone, joint) = pose.twists[joint];
    }
  }
  hessian_twists_.noalias() = links_.hessian() * twists_;
  equations.hessian.noalias() = twists_.transpose() * hessian_twists_;
  equations.gradient.noalias() = twists_.transpose() * links_.gradient();
}

template LinkMotions<float> LinkMotionsOf<float>(const TreePose&);
template LinkMotions<double> LinkMotionsOf<double>(const TreePose&);
template class LinkEquations<float>;
template class LinkEquations<double>;

}  // namespace vitruvia::dynamic
