// Label images packed as PNG, to hold those of a whole recording in memory; and the sheet of
// pictures that shows a cut.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cutout/cutout.h"

namespace vitruvia {

using PackedLabels = std::vector<std::uint8_t>;  // a PNG file's bytes
PackedLabels Pack(const Image<std::uint8_t>& labels);
Image<std::uint8_t> Unpacked(const PackedLabels& packed);

// One picture of a sheet: depth in grey, the chosen person green, other people in other colours
// with their numbers, a red border where the frame is unsure.
struct SheetFrame {
  int frame = 0;
  DepthImage depth;
  Image<std::uint8_t> people;
  bool is_unsure = false;
};

// The sheet as the bytes of a PNG file.
std::string CutoutSheet(const std::vector<SheetFrame>& frames, const ChosenPerson& chosen);

}  // namespace vitruvia
