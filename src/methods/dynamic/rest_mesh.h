// Normals of the rest mesh, updated with the warps, and each vertex's closest neighbours.
#pragma once

#include <array>
#include <vector>

#include "core/worker_team.h"
#include "geometry/mesh.h"
#include "methods/dynamic/surface.h"

namespace vitruvia::dynamic {

inline constexpr int kNeighbors = 4;  // paper B, sec. 4.3

// The closest vertices of each vertex in the rest mesh (eq. 9's N(i)), among those at most two
// edges away: vertices that are close but on another part of the body, such as the other thigh, are
// not neighbours. −1 if a vertex has fewer neighbours.
using NeighborTable = std::vector<std::array<int, kNeighbors>>;
NeighborTable ClosestNeighbors(const std::vector<Vector3f>& vertices,
                               const std::vector<Triangle>& triangles);

// Area-weighted vertex normals of a surface's rest columns, kept up to date without allocation.
class RestNormals {
 public:
  RestNormals(const SurfaceLayout& layout, const std::vector<Triangle>& triangles);
  void Update(WorkerTeam& team, Surface<float>& surface);

 private:
  std::vector<Triangle> triangles_;                      // of slots
  std::vector<int> first_face_, faces_;                  // of each slot, one after the other
  std::vector<Eigen::Array<float, 4, 1>> area_normals_;  // per triangle; the fourth is not used
};

}  // namespace vitruvia::dynamic
