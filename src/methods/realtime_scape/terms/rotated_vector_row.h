// Rows of ‖a − b‖² for two vectors that rotate with a bone and with its parent.
#pragma once

#include "methods/realtime_scape/body_pose.h"
#include "solver/block_normal_equations.h"

namespace vitruvia::realtime_scape {

// Three rows: a turns with `bone`, b with `parent` (−1: b is fixed). d(exp(r) a)/dr = −[a]×.
inline void AddRotatedVectorRows(int bone, const Vector3d& a, int parent, const Vector3d& b,
                                 double weight, BlockNormalEquations& equations) {
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d direction = Vector3d::Unit(axis);
    std::array<BlockNormalEquations::Entry, 2> entries;
    entries[0].block = bone;
    entries[0].jacobian << a.cross(direction), Vector3d::Zero();
    entries[1].block = parent;
    entries[1].jacobian << -b.cross(direction), Vector3d::Zero();
    equations.AddRow({entries.data(), parent < 0 ? 1u : 2u}, a[axis] - b[axis], weight);
  }
}

}  // namespace vitruvia::realtime_scape
