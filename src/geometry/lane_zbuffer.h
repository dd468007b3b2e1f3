// A z-buffer: depth of a triangle mesh seen by a pinhole camera.
//
// Pixel centres sample the triangles with perspective-correct depth (1/z is linear in the image).
// Triangles with a vertex nearer than `near_m` are not drawn at all: a tracked body stands in front
// of the camera. Eight triangles at a time are culled, sorted by the number of pixels in their
// boxes and then drawn in parallel, one pixel of each per step, which suits meshes whose triangles
// cover a few pixels each; and only the rows and columns that the mesh covers are cleared and read.
#pragma once

#include <array>

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
  // Faces whose boxes hold at most this many pixels; the first `count` are filled.
  struct FacesOfSize {
    float most_pixels;
    std::vector<int> faces{};  // with room to fill up the last lanes
    std::size_t count = 0;
  };
  struct BoxLanes;
  struct CornerLanes;
  struct TriangleLanes;

  void Project(const std::vector<Vector3f>& vertices_in_camera);
  void CollectDrawn(const std::vector<Triangle>& triangles);
  Box Draw(const std::vector<Triangle>& triangles);
  void DrawEight(const TriangleLanes& lanes, const BoxLanes& boxes);
  void Clear(const Box& box);
  void Invert(const Box& box);

  Rasterizer faces_;
  PinholeCamera camera_;
  float near_m_;
  DepthImage depth_;
  Box drawn_{0, 0, -1, -1};  // bounds of the drawn pixels of depth_
  std::vector<Corner> corners_;
  // The faces to draw whose boxes contain a pixel centre. Those side by side have boxes of similar
  // size, so that none waits for a large one.
  std::array<FacesOfSize, 4> faces_to_draw_;
};

}  // namespace vitruvia
