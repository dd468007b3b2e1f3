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
    : stride_(stride),
      before_(kMargin * stride + kMargin),
      near_m2_(static_cast<std::size_t>(stride) * (height_px + 2 * kMargin) + 2 * kMargin + kLanes,
               0.0f) {}

void PixelMotions::Reset(const PixelBox& box, int parts) {
  box_ = box;
  squared_m2_.resize(parts);
  for (auto& part : squared_m2_) part.resize(near_m2_.size(), 0.0f);
}

// Two pixels round the box are looked at by its neighbours.
void PixelMotions::Reset(int part) {
  const int columns = box_.last_column + 1 - box_.first_column + 2 * kMargin;
  for (int row = box_.first_row - kMargin; row <= box_.last_row + kMargin; ++row)
    std::fill_n(&squared_m2_[part][before_ + row * stride_ + box_.first_column - kMargin], columns,
                0.0f);
}

void PixelMotions::Spread(int begin_row, int end_row) {
  for (int row = begin_row; row < end_row; ++row) SpreadRow(row);
  if (begin_row == box_.first_row) SpreadRow(begin_row - 1);
  if (end_row == box_.last_row + 1) SpreadRow(end_row);
}

void PixelMotions::SpreadRow(int row) {
  const int begin = before_ + row * stride_ + box_.first_column - 1;
  const int end = before_ + row * stride_ + box_.last_column + 2;
  for (int i = begin; i < end; i += kLanes) {
    FloatLanes largest{};
    for (const std::vector<float>& part : squared_m2_) {
      for (const int middle : {i - stride_, i, i + stride_})
        largest = Max(largest, LargestOfThree(part, middle));
    }
    std::memcpy(&near_m2_[i], &largest, sizeof largest);
  }
}

}  // namespace vitruvia::dynamic
