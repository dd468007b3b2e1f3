// A z-buffer: depth of a triangle mesh seen by a pinhole camera.
//
// Pixel centres sample the triangles with perspective-correct depth (1/z is linear in the image).
// Triangles with a vertex nearer than `near_m` are not drawn at all: a tracked body stands in front
// of the camera. Eight triangles at a time are culled and then drawn in parallel, one pixel of each
// per step, which suits meshes whose triangles cover a few pixels each; and only the rows and
// columns that the mesh covers are cleared and read.
#pragma once

#include "geometry/mesh_rasterizer.h"

namespace vitruvia {

class LaneZBuffer : public MeshRasterizer {
 public:
  LaneZBuffer(Rasterizer faces, const PinholeCamera& camera, float near_m = 0.05f);

  const DepthImage& Render(const std::vector<Vector3f>& vertices_in_camera,
                           const std::vector<Triangle>& triangles) &
      final;

 private:
  // Four numbers, so that one load takes a corner.
  struct alignas(16) Corner {
    float u, v, inverse_z, unused;  // inverse_z 0: too near, or behind the camera
  };
  struct Box {  // of pixels, both ends included
    int left, top, right, bottom;
  };
  struct TriangleLanes;

  void Project(const std::vector<Vector3f>& vertices_in_camera);
  void CollectDrawn(const std::vector<Triangle>& triangles);
  Box Draw();
  void Clear(const Box& box);
  void Invert(const Box& box);

  Rasterizer faces_;
  PinholeCamera camera_;
  float near_m_;
  DepthImage depth_;
  Box drawn_{0, 0, -1, -1};  // bounds of the drawn pixels of depth_
  std::vector<Corner> corners_;
  // The first face_count_ are the faces to draw whose boxes contain a pixel centre, padded to a
  // multiple of kLanes.
  std::vector<Triangle> faces_to_draw_;
  std::size_t face_count_ = 0;
};

}  // namespace vitruvia
