#include "synth/sensor/shared_noise.h"

#include <algorithm>
#include <cmath>

namespace vitruvia {
namespace {

struct Span {
  int first, end;
  int size() const { return end - first; }
};

// The window round a column or row, cut off at the image's border.
Span WindowAt(int place, int width_px, int size) {
  const int first = place - (width_px - 1) / 2;
  return {std::max(first, 0), std::min(first + width_px, size)};
}

Image<double> SummedAlongRows(const Image<double>& image, int width_px) {
  Image<double> sums(image.width(), image.height());
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      const Span window = WindowAt(u, width_px, image.width());
      for (int x = window.first; x < window.end; ++x) sums(u, v) += image(x, v);
    }
  }
  return sums;
}

}  // namespace

Image<double> SharedNoise(const Image<double>& draws, int width_px) {
  if (width_px == 1) return draws;
  const Image<double> sums = SummedAlongRows(draws, width_px);
  Image<double> shared(draws.width(), draws.height());
  for (int v = 0; v < draws.height(); ++v) {
    const Span rows = WindowAt(v, width_px, draws.height());
    for (int u = 0; u < draws.width(); ++u) {
      const Span columns = WindowAt(u, width_px, draws.width());
      for (int y = rows.first; y < rows.end; ++y) shared(u, v) += sums(u, y);
      shared(u, v) /= std::sqrt(static_cast<double>(rows.size() * columns.size()));
    }
  }
  return shared;
}

}  // namespace vitruvia
