// Fewer triangles for the same surface: quadric edge collapse that keeps original vertices.
#pragma once

#include "geometry/mesh.h"

namespace vitruvia {

struct Decimation {
  std::vector<int> kept;            // new vertex → old vertex, ascending
  std::vector<Triangle> triangles;  // over the new vertices
};

// Collapses half-edges onto one of their ends in the order of their quadric error (Garland &
// Heckbert 1997) until target_vertices are left, so data given per vertex (such as weights) stays
// valid for the kept vertices. No collapse changes the topology, turns a triangle by more than a
// right angle or makes it a sliver; if no such collapse is left, more vertices remain. A mesh with
// fewer vertices is returned unchanged. DataError if the mesh is not a closed manifold.
Decimation Decimate(const TriangleMesh& mesh, int target_vertices);

}  // namespace vitruvia
