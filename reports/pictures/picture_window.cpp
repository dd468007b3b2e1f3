#include "reports/pictures/picture_window.h"

#include <algorithm>
#include <cmath>

#include "reports/drawing/color_maps.h"

namespace vitruvia {
namespace {

constexpr Color kNoDepth{0xf4, 0xf4, 0xf4};

}  // namespace

ImageBounds Projected(const PinholeCamera& camera, const std::vector<Vector3f>& points) {
  ImageBounds bounds;
  for (const Vector3f& point : points) {
    const Eigen::Vector2d pixel = camera.Project<double>(point.cast<double>());
    bounds.left = std::min(bounds.left, pixel.x());
    bounds.right = std::max(bounds.right, pixel.x());
    bounds.top = std::min(bounds.top, pixel.y());
    bounds.bottom = std::max(bounds.bottom, pixel.y());
  }
  return bounds;
}

PictureWindow Centered(const ImageBounds& bounds, double extent) {
  return {0.5 * (bounds.left + bounds.right - extent), 0.5 * (bounds.top + bounds.bottom - extent),
          extent, extent};
}

Vector3f Middle(const std::vector<Vector3f>& points) { return BoundingBox(points).center(); }

double Pixels(const PinholeCamera& camera, double length_m, const Vector3f& at) {
  return length_m * camera.fx / static_cast<double>(at.z());
}

void DepthRange::Include(const DepthImage& depth) {
  for (const float z_m : depth.pixels()) {
    if (z_m <= 0.0f) continue;
    nearest_ = std::min(nearest_, z_m);
    farthest_ = std::max(farthest_, z_m);
  }
}

double DepthRange::nearest_m() const {
  return farthest_ == 0.0f ? 0.0 : std::floor(10.0 * nearest_) / 10.0;
}

double DepthRange::farthest_m() const {
  return std::max(std::ceil(10.0 * farthest_) / 10.0, nearest_m() + 0.1);
}

ColorImage DepthPicture(const DepthImage& depth, const PictureWindow& part, int size,
                        double nearest_m, double farthest_m) {
  ColorImage picture(size, size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const auto pixel_of = [size](double start, double extent, int at) {
        return static_cast<int>(std::floor(start + extent * (at + 0.5) / size));
      };
      const int u = pixel_of(part.left, part.width, x), v = pixel_of(part.top, part.height, y);
      Color color = kNoDepth;
      if (depth.Contains(u, v) && depth(u, v) > 0.0f) {
        color = DepthColor((depth(u, v) - nearest_m) / (farthest_m - nearest_m));
      }
      picture(x, y) = {color[0], color[1], color[2], 255};
    }
  }
  return picture;
}

}  // namespace vitruvia
