#include "reports/drawing/thumbnail.h"

#include <algorithm>

namespace vitruvia {
namespace {

ColorPixel MeanOfBlock(const ColorImage& image, int left, int top, int size) {
  std::array<int, 3> sum{};
  for (int k = 0; k < size * size; ++k) {
    const ColorPixel& pixel = image(left + k % size, top + k / size);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += pixel[c];
  }
  ColorPixel mean{0, 0, 0, 255};
  for (std::size_t c = 0; c < 3; ++c) mean[c] = static_cast<std::uint8_t>(sum[c] / (size * size));
  return mean;
}

}  // namespace

ColorImage Thumbnail(const ColorImage& image, int width, double aspect) {
  const int block = std::max(1, (image.width() + width - 1) / width);
  const int small_width = image.width() / block;
  const int height = std::min(image.height() / block, static_cast<int>(aspect * small_width));
  ColorImage small(small_width, height);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < small_width; ++u)
      small(u, v) = MeanOfBlock(image, u * block, v * block, block);
  }
  return small;
}

}  // namespace vitruvia
