// A quick z-buffer of closed meshes: what a camera outside sees of them is their front faces.
//
// Gives the picture of ZBuffer, which is its reference, at a fraction of the time: back faces are
// dropped before anything is computed, and only the rows and columns that the mesh covers are
// cleared and read. Pictures differ where a mesh cuts through itself and its inside shows, and
// where rounding decides about a pixel on a silhouette.
#pragma once

#include "geometry/mesh_rasterizer.h"

namespace vitruvia {

class FrontFaceZBuffer final : public MeshRasterizer {
 public:
  explicit FrontFaceZBuffer(const PinholeCamera& camera, float near_m = 0.05f);

  // Triangles are counter-clockwise seen from outside; those with a vertex nearer than near_m are
  // left out whole. The result stays valid until the next call, as long as this object.
  const DepthImage& Render(const std::vector<Vector3f>& vertices_in_camera,
                           const std::vector<Triangle>& triangles) &
      override;

 private:
  struct Corner {
    float u, v, inverse_z;  // inverse_z 0: too near, or behind the camera
  };
  struct Box {  // of pixels, both ends included
    int left, top, right, bottom;
    bool empty() const { return left > right || top > bottom; }
  };

  Box Project(const std::vector<Vector3f>& vertices_in_camera);
  void DrawFrontFace(const Corner& a, const Corner& b, const Corner& c);
  void Clear(const Box& box);
  void Invert(const Box& box);

  PinholeCamera camera_;
  float near_m_;
  DepthImage depth_;
  Box drawn_{0, 0, -1, -1};  // what is not empty in depth_
  std::vector<Corner> corners_;
};

}  // namespace vitruvia
