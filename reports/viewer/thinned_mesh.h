// A mesh with fewer vertices, all of them the mesh's own: what is stored for each vertex holds for
// the thinned one too.
#pragma once

#include <vector>

#include "geometry/mesh.h"

namespace vitruvia {

struct ThinnedMesh {
  std::vector<std::uint32_t> kept;  // indices of the mesh's vertices
  std::vector<Triangle> triangles;  // indices into `kept`

  template <class Value>
  std::vector<Value> Of(const std::vector<Value>& per_vertex) const {
    std::vector<Value> values;
    values.reserve(kept.size());
    for (const std::uint32_t vertex : kept) values.push_back(per_vertex[vertex]);
    return values;
  }
};

// All vertices if there are no more than `most_vertices`; else about that many, chosen so that the
// rest pose keeps its form.
ThinnedMesh Thinned(const TriangleMesh& rest, int most_vertices);

}  // namespace vitruvia
