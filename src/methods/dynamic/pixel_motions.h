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

// A pixel's number is row · stride + column; the stride exceeds the width. The vertices come in
// parts, which may be noted on different threads.
class PixelMotions {
 public:
  PixelMotions(int stride, int height_px);

  // All vertices are inside of the box. To be called first.
  void Reset(const PixelBox& box, int parts);
  // No vertex of the part has moved.
  void Reset(int part);
  // A vertex of the part that is now at a pixel has moved by √squared_m2.
  void Note(int part, int pixel, float squared_m2) {
    float& largest = squared_m2_[part][pixel + before_];
    largest = std::max(largest, squared_m2);  // without a branch
  }
  // To be called for all rows of the box, after the last Note and before Near. Threads may work on
  // different rows.
  void Spread(int begin_row, int end_row);
  // No vertex at the pixel or its eight neighbours has moved farther, m². Where there is none, any
  // motion that was noted before may be returned.
  float Near(int pixel) const { return near_m2_[pixel + before_]; }

 private:
  static constexpr int kMargin = 2;  // empty rows before the first and after the last

  void SpreadRow(int row);

  int stride_, before_;  // before_: entries before the first row
  PixelBox box_;         // of the pixels that have a vertex
  // Per pixel, followed by kLanes dummies: the largest motion of each part, and that of all parts
  // at all nine pixels.
  std::vector<std::vector<float>> squared_m2_;
  std::vector<float> near_m2_;
};

}  // namespace vitruvia::dynamic
