// Fewer triangles for the same surface: quadric edge collapse that keeps original vertices.
#pragma once

#include "geometry/mesh.h"

namespace vitruvia {

struct Decimation {
  std::vector<int> kept;            // new vertex → old vertex, ascending
  std::vector<Triangle> triangles;  // over the new vertices
};

// Collapses half-edges onto one of their ends in the order of their quadric error (Garland &
// Heckbert 1997) until target_vertices are left, so whatever belongs to vertices carries over. No
// collapse changes the topology, turns a triangle by more than a right angle or makes it a sliver;
// where that leaves no choice, more vertices stay. A mesh of fewer vertices stays as it is.
// DataError if the mesh is not a closed manifold.
Decimation Decimate(const TriangleMesh& mesh, int target_vertices);

}  // namespace vitruvia
