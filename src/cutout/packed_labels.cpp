#include "cutout/packed_labels.h"

#include <algorithm>

namespace vitruvia {

PackedLabels Pack(const Image<std::uint8_t>& labels) {
  PackedLabels packed{labels.width(), labels.height(), {}};
  for (const std::uint8_t label : labels.pixels()) {
    if (packed.runs.empty() || packed.runs.back().label != label) packed.runs.push_back({0, label});
    ++packed.runs.back().pixels;
  }
  return packed;
}

Image<std::uint8_t> Unpacked(const PackedLabels& packed) {
  Image<std::uint8_t> labels(packed.width, packed.height);
  auto next = labels.pixels().begin();
  for (const PackedLabels::Run& run : packed.runs) next = std::fill_n(next, run.pixels, run.label);
  return labels;
}

}  // namespace vitruvia
