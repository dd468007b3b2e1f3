// The silhouette of a frame's measured pixels: finds the nearest of them for any pixel.
#pragma once

#include <optional>

#include "geometry/camera.h"
#include "geometry/image.h"

namespace vitruvia::capsule_icp {

class Silhouette {
 public:
  // Pixels farther than reach_px columns or rows from all measured ones have no nearest pixel.
  Silhouette(const PinholeCamera& camera, int reach_px);

  void Observe(const DepthImage& depth, float max_depth_m);
  // The measured pixel nearest to one of the image (itself if it is measured); nothing if none is
  // in reach. Exact to a fraction of a pixel (Danielsson's sequential distance mapping).
  std::optional<Pixel> NearestTo(const Pixel& pixel) const;

 private:
  struct Offset {
    std::int16_t du, dv;
  };

  void Clear();
  void Sweep(int from_v, int to_v, int step);
  void Improve(int u, int v, int du, int dv);

  int width_, height_, reach_px_;
  int left_ = 0, top_ = 0, right_ = -1, bottom_ = -1;  // of the measured pixels, widened by reach
  Image<Offset> offsets_;                              // to the nearest measured pixel
};

}  // namespace vitruvia::capsule_icp
