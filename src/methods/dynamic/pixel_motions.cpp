#include "methods/dynamic/pixel_motions.h"

#include <algorithm>

#include "math/lanes.h"

namespace vitruvia::dynamic {
namespace {

// Eight times the largest of three neighbours in a row.
FloatLanes LargestOfThree(const std::vector<float>& row, int middle) {
  return Max(Max(LoadLanes<FloatLanes>(row, middle - 1), LoadLanes<FloatLanes>(row, middle)),
             LoadLanes<FloatLanes>(row, middle + 1));
}

}  // namespace

PixelMotions::PixelMotions(int stride, int height_px)
    : stride_(stride), before_(kMargin * stride + kMargin) {
  const auto entries = static_cast<std::size_t>(stride) * (height_px + 2 * kMargin) + 2 * kMargin;
  for (auto* pixels : {&squared_m2_, &near_m2_}) pixels->assign(entries + kLanes, 0.0f);
}

void PixelMotions::Reset(const PixelBox& box) {
  near_box_ = {box.first_row - 1, box.last_row + 1, box.first_column - 1, box.last_column + 1};
  const int columns = near_box_.last_column + 1 - near_box_.first_column;
  for (int row = near_box_.first_row - 1; row <= near_box_.last_row + 1; ++row)
    std::fill_n(&squared_m2_[before_ + row * stride_ + near_box_.first_column - 1], columns + 2,
                0.0f);
}

void PixelMotions::Spread() {
  for (int row = near_box_.first_row; row <= near_box_.last_row; ++row) {
    const int begin = before_ + row * stride_ + near_box_.first_column;
    const int end = before_ + row * stride_ + near_box_.last_column + 1;
    for (int i = begin; i < end; i += kLanes) {
      const FloatLanes largest =
          Max(Max(LargestOfThree(squared_m2_, i - stride_), LargestOfThree(squared_m2_, i)),
              LargestOfThree(squared_m2_, i + stride_));
      std::memcpy(&near_m2_[i], &largest, sizeof largest);
    }
  }
}

}  // namespace vitruvia::dynamic
