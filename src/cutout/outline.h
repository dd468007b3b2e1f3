// Outlines of people, smoothed: a depth camera displaces the edge of a surface by about a pixel, at
// each pixel by a different amount, and mixes the depths of both surfaces.
#pragma once

#include <cstdint>
#include <vector>

#include "cutout/pieces.h"

namespace vitruvia {

struct OutlinedPeople {
  Image<std::uint8_t> people;  // number of the person at each pixel, from 1; 0: nobody
  // Indices of measured pixels inside an outline that hold another depth than the person's, in
  // ascending order: the room's, or a mixture of both.
  std::vector<int> foreign_depth;
};

// `people`: number of the person at each pixel of the pieces, 0: nobody. Each pixel near an outline
// is assigned by a weighted mean over the pixels round it. A pixel of a person counts 1, and one of
// another piece 0. Any other counts the share of the way from the room's depth to the person's at
// which its depth lies, so that a foot continues down to the floor; a pixel without measurement, or
// with a depth that is neither the person's nor the room's, is background with a lower weight.
// A part that is thinner than the reach and longer than twice the reach keeps its pixels.
// Boundaries between two people stay as they are.
OutlinedPeople SmoothOutlines(const DepthImage& depth, const Pieces& pieces, const Room& room,
                              const CutoutSettings& settings, const Image<std::uint8_t>& people);

}  // namespace vitruvia
