// Incidence angle and edges of the surface in a depth image.
#pragma once

#include "geometry/camera.h"
#include "geometry/image.h"
#include "geometry/mesh.h"

namespace vitruvia {

// Neighbouring pixels whose depths differ by more than this lie on different surfaces. At 3 m and
// 320 columns, a surface at an incidence angle of 78 degrees reaches this difference.
inline constexpr float kEdgeJumpM = 0.05f;

// Both measured and on one surface.
inline bool AreOnOneSurface(float z, float other_z) {
  return z > 0.0f && other_z > 0.0f && z - other_z < kEdgeJumpM && other_z - z < kEdgeJumpM;
}

// Radians in [0, π/2] between the surface's normal and the ray of each measured pixel, by
// differences between neighbours on the same surface; 0 where a pixel has none in some direction.
Image<float> IncidenceAngles(const DepthImage& depth, const PinholeCamera& camera);

// Whether a measured pixel has one of its eight neighbours not on its surface, or an empty pixel
// has a measured neighbour. The image's border is not an edge.
bool IsAtEdge(const DepthImage& depth, int u, int v);

}  // namespace vitruvia
