// Renders the depth of a triangle mesh with OSMesa, for ground truth. Needs no display.
#pragma once

#include <memory>

#include "geometry/camera.h"
#include "geometry/image.h"
#include "geometry/mesh.h"

namespace vitruvia {

class DepthRenderer {
 public:
  explicit DepthRenderer(const PinholeCamera& camera, double near_m = 0.2, double far_m = 10.0);
  ~DepthRenderer();

  // Vertices in the camera frame, metres. Depth along z at pixel centres, 0 where no triangle is.
  DepthImage Render(const std::vector<Vector3f>& vertices_in_camera,
                    const std::vector<Triangle>& triangles);

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

}  // namespace vitruvia
