#include "geometry/mesh_rasterizer.h"

#include "geometry/front_face_zbuffer.h"
#include "geometry/zbuffer.h"

namespace vitruvia {

std::unique_ptr<MeshRasterizer> MakeRasterizer(Rasterizer rasterizer, const PinholeCamera& camera) {
  if (rasterizer == Rasterizer::kAllTriangles) return std::make_unique<ZBuffer>(camera);
  return std::make_unique<FrontFaceZBuffer>(camera);
}

}  // namespace vitruvia
