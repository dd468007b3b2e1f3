// The part of an image in which a sensor may measure something.
#pragma once

#include "core/random.h"
#include "geometry/image.h"

namespace vitruvia {

struct PixelBox {
  int left = 0, top = 0, right = 0, bottom = 0;  // right and bottom are not part of it

  bool Contains(int u, int v) const { return u >= left && v >= top && u < right && v < bottom; }
  PixelBox Grown(int margin_px, const DepthImage& image) const;
};

// The box of all pixels that are at most margin_px from one with a depth; empty if there is none.
// The whole image if its number of pixels is odd (NormalDraws).
PixelBox MeasuredBox(const DepthImage& depth, int margin_px);

// Standard normal numbers of a stream, one call of RandomStream::Normal after the other, of which
// those that nobody needs are left out without being computed: pixels inside a box have the same
// noise for any box. Their number must be even, because the stream draws them in pairs.
class NormalDraws {
 public:
  explicit NormalDraws(RandomStream& stream) : stream_(stream), pair_(stream) {}

  double Next(bool is_needed);

 private:
  RandomStream& stream_;
  RandomStream pair_;  // at the pair that is being drawn
  bool has_second_ = false, is_first_drawn_ = false;
};

}  // namespace vitruvia
