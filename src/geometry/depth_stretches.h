// Skips the empty parts of depth images: most pixels of a person's images hold no depth.
#pragma once

#include <algorithm>
#include <initializer_list>

#include "math/lanes.h"

namespace vitruvia {

// Calls body(begin, end) for stretches of columns, from left to right, that hold all multiples of
// `stride` at which one of the rows has a positive depth. Each begin is a multiple of `stride`.
template <class Body>
void ForEachStretchWithDepth(int width, int stride, std::initializer_list<const float*> rows,
                             const Body& body) {
  const int step = (kLanes + stride - 1) / stride * stride;  // no fewer than kLanes columns
  const auto has_depth = [&](int column) {
    return std::any_of(rows.begin(), rows.end(), [&](const float* row) {
      for (int first = column; first < column + step; first += kLanes) {
        const int within_row = std::min(first, width - kLanes);
        if (IsAnyPositive(row + within_row)) return true;
      }
      return false;
    });
  };
  for (int column = 0; column < width; column += step) {
    if (width < kLanes || has_depth(column)) body(column, std::min(column + step, width));
  }
}

}  // namespace vitruvia
