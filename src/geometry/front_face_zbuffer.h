// A quick z-buffer of closed meshes: what a camera outside sees of them is their front faces.
//
// Gives the picture of ZBuffer, which is its reference, at a fraction of the time: eight triangles
// are culled and then drawn side by side, one pixel of each at a time, which suits meshes whose
// triangles cover a few pixels each; and only the rows and columns that the mesh covers are cleared
// and read. Pictures differ where a mesh cuts through itself and its inside shows, and where
// rounding decides about a pixel on a silhouette.
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
  };
  struct TriangleLanes;

  void Project(const std::vector<Vector3f>& vertices_in_camera);
  void CollectFrontFaces(const std::vector<Triangle>& triangles);
  Box DrawFrontFaces();
  void Clear(const Box& box);
  void Invert(const Box& box);

  PinholeCamera camera_;
  float near_m_;
  DepthImage depth_;
  Box drawn_{0, 0, -1, -1};  // what is not empty in depth_
  std::vector<Corner> corners_;
  // The front faces whose boxes hold a pixel centre: the first front_face_count_, whole lanes.
  std::vector<Triangle> front_faces_;
  std::size_t front_face_count_ = 0;
};

}  // namespace vitruvia
