// The blend of a patch's dual quaternions for eight vertices (paper B, eq. 3).
#pragma once

#include <array>

#include "methods/dynamic/surface.h"

namespace vitruvia::dynamic {

template <class Scalar>
Lanes<Scalar> Load(const std::vector<Scalar>& column, int slot) {
  return LoadLanes<Lanes<Scalar>>(column, slot);
}
// The numbers of eight slots, in any order.
using SlotLanes = std::array<int, kLanes>;
template <class Scalar>
[[gnu::always_inline]] inline Lanes<Scalar> Load(const std::vector<Scalar>& column,
                                                 const SlotLanes& slots) {
  return Gather(column.data(), slots);
}

// Eight 3-vectors. They are loaded from eight slots side by side, given by the first one, or from
// any eight.
template <class Scalar>
struct LaneVector {
  Lanes<Scalar> x, y, z;

  template <class Slots>
  static LaneVector Load(const Columns<Scalar>& columns, const Slots& slots) {
    return {dynamic::Load<Scalar>(columns.x, slots), dynamic::Load<Scalar>(columns.y, slots),
            dynamic::Load<Scalar>(columns.z, slots)};
  }
  void Store(int slot, Columns<Scalar>& columns) const {
    StoreLanes(x, slot, columns.x);
    StoreLanes(y, slot, columns.y);
    StoreLanes(z, slot, columns.z);
  }
};

// Inlining is forced: otherwise GCC emits calls that pass eight lanes through memory, which slows
// skinning down by half.
template <class Scalar>
[[gnu::always_inline]] inline Lanes<Scalar> Dot(const LaneVector<Scalar>& a,
                                                const LaneVector<Scalar>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Scalar>
[[gnu::always_inline]] inline LaneVector<Scalar> Cross(const LaneVector<Scalar>& a,
                                                       const LaneVector<Scalar>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Bones of a patch, each flipped into the hemisphere of the first.
template <class Scalar>
std::array<DualQuaternion<Scalar>, kMaxInfluences> InOneHemisphere(
    const Patch& patch, const BoneMotions<Scalar>& bones) {
  std::array<DualQuaternion<Scalar>, kMaxInfluences> result;
  for (int k = 0; k < patch.influences; ++k) {
    result[k] = bones[patch.bones[k]];
    if (result[k].real.dot(result[0].real) >= Scalar(0)) continue;
    result[k].real.coeffs() *= Scalar(-1);
    result[k].dual.coeffs() *= Scalar(-1);
  }
  return result;
}

// b = Σ w_k q̂_k, not yet divided by the norm of its real part: (a, u) + ε (b, d).
template <class Scalar>
struct LaneBlend {
  Lanes<Scalar> a, b;
  LaneVector<Scalar> u, d;
  Lanes<Scalar> inverse_square;  // 1 / |(a, u)|²

  template <int N, class Slots>
  static LaneBlend Of(const std::array<DualQuaternion<Scalar>, kMaxInfluences>& q,
                      const std::array<std::vector<Scalar>, kMaxInfluences>& weights,
                      const Slots& slots) {
    LaneBlend blend;
    const Lanes<Scalar> first = Load<Scalar>(weights[0], slots);
    blend.a = first * q[0].real.w();
    blend.u = {first * q[0].real.x(), first * q[0].real.y(), first * q[0].real.z()};
    blend.b = first * q[0].dual.w();
    blend.d = {first * q[0].dual.x(), first * q[0].dual.y(), first * q[0].dual.z()};
    for (int k = 1; k < N; ++k) {
      const Lanes<Scalar> w = Load<Scalar>(weights[k], slots);
      blend.a += w * q[k].real.w();
      blend.u.x += w * q[k].real.x();
      blend.u.y += w * q[k].real.y();
      blend.u.z += w * q[k].real.z();
      blend.b += w * q[k].dual.w();
      blend.d.x += w * q[k].dual.x();
      blend.d.y += w * q[k].dual.y();
      blend.d.z += w * q[k].dual.z();
    }
    blend.inverse_square = Scalar(1) / (blend.a * blend.a + Dot(blend.u, blend.u));
    return blend;
  }

  // R v = v + 2/n² u × (u × v + a v).
  [[gnu::always_inline]] LaneVector<Scalar> Rotated(const LaneVector<Scalar>& v) const {
    LaneVector<Scalar> inner = Cross(u, v);
    inner.x += a * v.x;
    inner.y += a * v.y;
    inner.z += a * v.z;
    const LaneVector<Scalar> outer = Cross(u, inner);
    const Lanes<Scalar> scale = Scalar(2) * inverse_square;
    return {v.x + scale * outer.x, v.y + scale * outer.y, v.z + scale * outer.z};
  }

  // t = 2/n² vec(q_d q_r*).
  [[gnu::always_inline]] LaneVector<Scalar> Translation() const {
    const LaneVector<Scalar> cross = Cross(u, d);
    const Lanes<Scalar> scale = Scalar(2) * inverse_square;
    return {scale * (a * d.x - b * u.x + cross.x), scale * (a * d.y - b * u.y + cross.y),
            scale * (a * d.z - b * u.z + cross.z)};
  }

  // The scalar part of q_d q_r* / n²: 0 of a unit dual quaternion, not of a blend.
  Lanes<Scalar> Excess() const { return inverse_square * (a * b + Dot(u, d)); }
};

}  // namespace vitruvia::dynamic
