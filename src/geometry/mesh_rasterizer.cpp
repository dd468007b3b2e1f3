#include "geometry/mesh_rasterizer.h"

#include "geometry/lane_zbuffer.h"

namespace vitruvia {

std::unique_ptr<MeshRasterizer> MakeRasterizer(Rasterizer faces, const PinholeCamera& camera) {
  return std::make_unique<LaneZBuffer>(faces, camera);
}

}  // namespace vitruvia
