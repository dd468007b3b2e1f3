#include "synth/sensor/measured_box.h"

#include <algorithm>

namespace vitruvia {

PixelBox PixelBox::Grown(int margin_px, const DepthImage& image) const {
  if (left >= right) return *this;
  return {std::max(left - margin_px, 0), std::max(top - margin_px, 0),
          std::min(right + margin_px, image.width()), std::min(bottom + margin_px, image.height())};
}

PixelBox MeasuredBox(const DepthImage& depth, int margin_px) {
  if (depth.pixels().size() % 2 != 0) return {0, 0, depth.width(), depth.height()};
  PixelBox box{depth.width(), depth.height(), 0, 0};
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      if (!(depth(u, v) > 0.0f)) continue;
      box = {std::min(box.left, u), std::min(box.top, v), std::max(box.right, u + 1),
             std::max(box.bottom, v + 1)};
    }
  }
  return box.Grown(margin_px, depth);
}

double NormalDraws::Next(bool is_needed) {
  if (!has_second_) {
    pair_ = stream_;
    stream_.NextBits();
    stream_.NextBits();
    has_second_ = true;
    is_first_drawn_ = is_needed;
    return is_needed ? pair_.Normal() : 0.0;
  }
  has_second_ = false;
  if (!is_needed) return 0.0;
  if (!is_first_drawn_) pair_.Normal();
  return pair_.Normal();
}

}  // namespace vitruvia
