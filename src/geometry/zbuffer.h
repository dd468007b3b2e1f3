// A small z-buffer: depth of a triangle mesh seen by a pinhole camera.
//
// Pixel centres sample the triangles with perspective-correct depth (1/z is linear in the image).
// Triangles with a vertex nearer than `near_m` are not drawn at all: a tracked body stands in front
// of the camera. Both sides of a triangle are drawn.
#pragma once

#include "geometry/mesh_rasterizer.h"

namespace vitruvia {

class ZBuffer final : public MeshRasterizer {
 public:
  explicit ZBuffer(const PinholeCamera& camera, float near_m = 0.05f);

  // Draws into a cleared buffer. The result stays valid until the next call or the end of this
  // object.
  const DepthImage& Render(const std::vector<Vector3f>& vertices_in_camera,
                           const std::vector<Triangle>& triangles) &
      override;

 private:
  void Project(const std::vector<Vector3f>& vertices_in_camera);
  void DrawTriangle(const Triangle& triangle);

  PinholeCamera camera_;
  float near_m_;
  DepthImage depth_;
  std::vector<Vector3f> projected_;  // u, v, 1/z
};

}  // namespace vitruvia
