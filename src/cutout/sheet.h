// A contact sheet that shows the cutout.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cutout/cutout.h"

namespace vitruvia {

// One picture of a sheet: depth in grey, the chosen person in green, other people in other colours
// with their numbers, and a red border if the frame is unsure.
struct SheetFrame {
  int frame = 0;
  DepthImage depth;
  Image<std::uint8_t> people;
  bool is_unsure = false;
};

// The sheet as the bytes of a PNG file.
std::string CutoutSheet(const std::vector<SheetFrame>& frames, const ChosenPerson& chosen);

}  // namespace vitruvia
