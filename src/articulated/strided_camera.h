// A camera of reduced resolution.
#pragma once

#include "geometry/camera.h"

namespace vitruvia::articulated {

// The camera that sees every `stride`-th column and row of another's.
inline PinholeCamera Strided(const PinholeCamera& camera, int stride) {
  return {(camera.width + stride - 1) / stride,
          (camera.height + stride - 1) / stride,
          camera.fx / stride,
          camera.fy / stride,
          camera.cx / stride,
          camera.cy / stride};
}

}  // namespace vitruvia::articulated
