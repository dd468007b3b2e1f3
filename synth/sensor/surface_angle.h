// What a depth image tells of the surface that it shows: its slope, and where it ends.
#pragma once

#include "geometry/camera.h"
#include "geometry/image.h"
#include "geometry/mesh.h"

namespace vitruvia {

// Neighbouring pixels whose depths differ by more lie on different surfaces. At 3 m and 320 columns
// a surface reaches it at an angle of 78 degrees.
inline constexpr float kEdgeJumpM = 0.05f;

// Both measured and on one surface.
inline bool AreOnOneSurface(float z, float other_z) {
  return z > 0.0f && other_z > 0.0f && z - other_z < kEdgeJumpM && other_z - z < kEdgeJumpM;
}

// Radians in [0, π/2] between the surface's normal and the ray of each measured pixel, by
// differences between neighbours on the same surface; 0 where a pixel has none in some direction.
Image<float> IncidenceAngles(const DepthImage& depth, const PinholeCamera& camera);

// Whether one of the eight neighbours of a measured pixel is not on its surface, or one of those of
// an empty pixel is measured. The image's border is no edge.
bool IsAtEdge(const DepthImage& depth, int u, int v);

}  // namespace vitruvia
