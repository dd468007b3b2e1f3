// Run-length encoding of label images, to keep those of a whole recording in memory.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/image.h"

namespace vitruvia {

struct PackedLabels {
  struct Run {
    int pixels = 0;  // in row-major order
    std::uint8_t label = 0;
  };
  int width = 0, height = 0;
  std::vector<Run> runs;
};

PackedLabels Pack(const Image<std::uint8_t>& labels);
Image<std::uint8_t> Unpacked(const PackedLabels& packed);

}  // namespace vitruvia
