// The surface point of a mesh that each pixel of a camera shows.
#pragma once

#include <array>
#include <vector>

#include "geometry/camera.h"
#include "geometry/image.h"
#include "geometry/mesh.h"

namespace vitruvia {

struct SurfaceSample {
  float depth_m = 0.0f;  // along z; 0: the pixel shows nothing
  int triangle = 0;
  std::array<float, 3> barycentric{};
};

// Casts the ray of each pixel's centre, camera frame. The mesh must be closed, with triangles
// counter-clockwise seen from outside, and lie in front of the camera.
Image<SurfaceSample> SampleSurface(const std::vector<Vector3f>& vertices_in_camera,
                                   const std::vector<Triangle>& triangles,
                                   const PinholeCamera& camera);

DepthImage DepthOf(const Image<SurfaceSample>& samples);

}  // namespace vitruvia
