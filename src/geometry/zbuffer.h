// A z-buffer that draws both sides of every triangle.
#pragma once

#include "geometry/lane_zbuffer.h"

namespace vitruvia {

class ZBuffer final : public LaneZBuffer {
 public:
  explicit ZBuffer(const PinholeCamera& camera, float near_m = 0.05f)
      : LaneZBuffer(Rasterizer::kAllTriangles, camera, near_m) {}
};

}  // namespace vitruvia
