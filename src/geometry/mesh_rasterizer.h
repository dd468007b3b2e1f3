// Renders the depth of a triangle mesh in a pinhole camera, by one of two z-buffers.
#pragma once

#include <memory>

#include "geometry/camera.h"
#include "geometry/image.h"
#include "geometry/mesh.h"

namespace vitruvia {

enum class Rasterizer {
  kAllTriangles,  // both sides of every triangle: zbuffer.h
  kFrontFaces,    // front faces only, for a camera outside a closed mesh: front_face_zbuffer.h
};

class MeshRasterizer {
 public:
  virtual ~MeshRasterizer() = default;
  // Depth at pixel centres, 0 where no triangle is. The result stays valid until the next call or
  // the end of this object.
  virtual const DepthImage& Render(const std::vector<Vector3f>& vertices_in_camera,
                                   const std::vector<Triangle>& triangles) & = 0;
};

std::unique_ptr<MeshRasterizer> MakeRasterizer(Rasterizer rasterizer, const PinholeCamera& camera);

}  // namespace vitruvia
