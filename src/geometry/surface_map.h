// Points of one surface mapped to another, each as a triangle and barycentric coordinates.
#pragma once

#include <vector>

#include "geometry/mesh.h"

namespace vitruvia {

struct SurfacePoint {
  std::int32_t triangle = 0;
  std::array<float, 3> barycentric{1.0f, 0.0f, 0.0f};
};

// For each point its closest point on the mesh (exact).
std::vector<SurfacePoint> ClosestSurfacePoints(const std::vector<Vector3f>& points,
                                               const TriangleMesh& mesh);

inline Vector3f Evaluate(const SurfacePoint& p, const Vector3f* vertices,
                         const std::vector<Triangle>& triangles) {
  const Triangle& t = triangles[static_cast<std::size_t>(p.triangle)];
  return p.barycentric[0] * vertices[t[0]] + p.barycentric[1] * vertices[t[1]] +
         p.barycentric[2] * vertices[t[2]];
}

}  // namespace vitruvia
