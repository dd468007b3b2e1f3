// What tests measure on body surfaces.
#pragma once

#include <functional>

#include "geometry/mesh.h"

namespace vitruvia {

// Length of a tape pulled round the part of the surface that a plane cuts and `keep` admits: the
// convex hull of the cut. Metres.
double TapeGirth(const TriangleMesh& mesh, const Vector3d& point_on_plane, const Vector3d& normal,
                 const std::function<bool(const Vector3d&)>& keep);

// How often the surface winds round a point: 1 inside, 0 outside (sum of the triangles' solid
// angles over 4π).
double WindingNumber(const TriangleMesh& mesh, const Vector3d& point);

// Pairs of triangles that pass through each other without sharing a vertex.
int CountSelfIntersections(const TriangleMesh& mesh);

}  // namespace vitruvia
