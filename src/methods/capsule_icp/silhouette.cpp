#include "methods/capsule_icp/silhouette.h"

#include <algorithm>

namespace vitruvia::capsule_icp {
namespace {

constexpr std::int16_t kFar = 16000;

int Squared(int du, int dv) { return du * du + dv * dv; }

}  // namespace

Silhouette::Silhouette(const PinholeCamera& camera, int reach_px)
    : width_(camera.width),
      height_(camera.height),
      reach_px_(reach_px),
      offsets_(camera.width, camera.height, Offset{kFar, kFar}) {}

void Silhouette::Clear() {
  for (int v = top_; v <= bottom_; ++v) {
    std::fill(&offsets_(left_, v), &offsets_(right_, v) + 1, Offset{kFar, kFar});
  }
}

void Silhouette::Observe(const DepthImage& depth, float max_depth_m) {
  Clear();
  int left = width_, top = height_, right = -1, bottom = -1;
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u) {
      const float z = depth(u, v);
      if (!(z > 0.0f && z <= max_depth_m)) continue;
      offsets_(u, v) = {0, 0};
      left = std::min(left, u);
      right = std::max(right, u);
      top = std::min(top, v);
      bottom = v;
    }
  }
  left_ = std::max(left - reach_px_, 0);
  top_ = std::max(top - reach_px_, 0);
  right_ = std::min(right + reach_px_, width_ - 1);
  bottom_ = std::min(bottom + reach_px_, height_ - 1);
  if (right < 0) right_ = bottom_ = -1;
  Sweep(top_, bottom_, 1);
  Sweep(bottom_, top_, -1);
}

// Row by row: from the row before, then along the row both ways.
void Silhouette::Sweep(int from_v, int to_v, int step) {
  if (right_ < left_) return;
  for (int v = from_v; v != to_v + step; v += step) {
    const int before = v - step;
    if (before >= top_ && before <= bottom_) {
      for (int u = left_; u <= right_; ++u) Improve(u, v, 0, -step);
    }
    for (int u = left_ + 1; u <= right_; ++u) Improve(u, v, -1, 0);
    for (int u = right_ - 1; u >= left_; --u) Improve(u, v, 1, 0);
  }
}

// Takes the neighbour's nearest pixel if it is nearer than the pixel's own.
void Silhouette::Improve(int u, int v, int du, int dv) {
  const Offset& neighbor = offsets_(u + du, v + dv);
  if (neighbor.du == kFar) return;
  Offset& own = offsets_(u, v);
  const int new_u = neighbor.du + du, new_v = neighbor.dv + dv;
  if (Squared(new_u, new_v) < Squared(own.du, own.dv)) {
    own = {static_cast<std::int16_t>(new_u), static_cast<std::int16_t>(new_v)};
  }
}

std::optional<Pixel> Silhouette::NearestTo(const Pixel& pixel) const {
  const Offset& offset = offsets_(pixel.u, pixel.v);
  if (offset.du == kFar) return {};
  return Pixel{pixel.u + offset.du, pixel.v + offset.dv};
}

}  // namespace vitruvia::capsule_icp
