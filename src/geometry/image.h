// A row-major image. DepthImage: float metres along z, 0 = no measurement.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vitruvia {

template <class Pixel>
class Image {
 public:
  Image() = default;
  Image(int width, int height, Pixel fill = Pixel{})
      : width_(width), height_(height), pixels_(static_cast<std::size_t>(width) * height, fill) {}

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return pixels_.empty(); }
  bool Contains(int u, int v) const { return u >= 0 && v >= 0 && u < width_ && v < height_; }
  Pixel& operator()(int u, int v) { return pixels_[static_cast<std::size_t>(v) * width_ + u]; }
  const Pixel& operator()(int u, int v) const {
    return pixels_[static_cast<std::size_t>(v) * width_ + u];
  }
  std::vector<Pixel>& pixels() { return pixels_; }
  const std::vector<Pixel>& pixels() const { return pixels_; }

 private:
  int width_ = 0, height_ = 0;
  std::vector<Pixel> pixels_;
};

using DepthImage = Image<float>;
using MaskImage = Image<std::uint8_t>;

}  // namespace vitruvia
