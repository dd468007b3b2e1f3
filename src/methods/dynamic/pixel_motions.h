// How far the vertices that face the camera have moved from one projection to the next, pixel by
// pixel.
#pragma once

#include <algorithm>
#include <vector>

namespace vitruvia::dynamic {

// A part of the image, both ends included; empty by default.
struct PixelBox {
  int first_row = 0, last_row = -1, first_column = 0, last_column = -1;
};

// A pixel's number is row · stride + column; the stride exceeds the width.
class PixelMotions {
 public:
  PixelMotions(int stride, int height_px);

  // No vertex has moved, and all vertices are inside of the box.
  void Reset(const PixelBox& box);
  // A vertex that is now at a pixel has moved by √squared_m2. Threads may work on different rows.
  void Note(int pixel, float squared_m2) {
    float& largest = squared_m2_[pixel + before_];
    largest = std::max(largest, squared_m2);  // without a branch
  }
  // To be called after the last Note and before Near.
  void Spread();
  // No vertex at the pixel or its eight neighbours has moved farther, m². Where there is none, any
  // motion that was noted before may be returned.
  float Near(int pixel) const { return near_m2_[pixel + before_]; }

 private:
  static constexpr int kMargin = 2;  // empty rows before the first and after the last

  int stride_, before_;  // before_: entries before the first row
  PixelBox near_box_;    // of the pixels that have a vertex or a neighbour with one
  // Per pixel, followed by kLanes dummies: the largest motion, and that of all nine.
  std::vector<float> squared_m2_, near_m2_;
};

}  // namespace vitruvia::dynamic
