// Simple solids that represent bones and axes in drawings of a model.
#pragma once

#include "geometry/mesh.h"

namespace vitruvia {

// Two four-sided pyramids with a common base of width width_m, at share `base` of the line.
TriangleMesh Spindle(const Vector3d& from, const Vector3d& to, double width_m, double base);

// An arrow from `from` to `to`.
TriangleMesh Arrow(const Vector3d& from, const Vector3d& to, double width_m);

void Append(const TriangleMesh& part, TriangleMesh& mesh);

}  // namespace vitruvia
