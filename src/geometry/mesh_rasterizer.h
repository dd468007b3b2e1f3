// Depth of a triangle mesh as a pinhole camera sees it, by one of two z-buffers.
#pragma once

#include <memory>

#include "geometry/camera.h"
#include "geometry/image.h"
#include "geometry/mesh.h"

namespace vitruvia {

enum class Rasterizer {
  kAllTriangles,  // both sides of every triangle: zbuffer.h
  kFrontFaces,    // what a camera outside a closed mesh sees: front_face_zbuffer.h
};

class MeshRasterizer {
 public:
  virtual ~MeshRasterizer() = default;
  // Depth at pixel centres, 0 where nothing is. The result stays valid until the next call, as
  // long as this object.
  virtual const DepthImage& Render(const std::vector<Vector3f>& vertices_in_camera,
                                   const std::vector<Triangle>& triangles) & = 0;
};

std::unique_ptr<MeshRasterizer> MakeRasterizer(Rasterizer rasterizer, const PinholeCamera& camera);

}  // namespace vitruvia
