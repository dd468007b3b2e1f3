// Catmull–Clark subdivision of closed quad meshes, as a linear map.
//
// The rule is linear in the vertices, so one sparse matrix per step applies to both positions and
// skinning weights: each new value is a convex combination of old ones.
#pragma once

#include <Eigen/SparseCore>

#include "geometry/mesh.h"

namespace vitruvia {

struct SubdivisionStep {
  Eigen::SparseMatrix<float, Eigen::RowMajor> new_from_old;  // V' × V; rows sum to 1
  std::vector<Quad> quads;                                   // four for each old quad
};

// Catmull & Clark 1978. DataError if the mesh is not closed or not manifold.
SubdivisionStep CatmullClark(const std::vector<Quad>& quads, int vertex_count);

}  // namespace vitruvia
