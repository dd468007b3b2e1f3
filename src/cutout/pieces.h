// Connected components of foreground pixels in three dimensions.
#pragma once

#include <cstdint>
#include <vector>

#include "cutout/room.h"

namespace vitruvia {

struct Piece {
  int pixels = 0;
  double area_m2 = 0.0;  // sum of each pixel's footprint at its depth
  double mean_depth_m = 0.0;
  Eigen::AlignedBox3f box;                  // camera frame
  float lowest_m = 0.0f, highest_m = 0.0f;  // along the room's vertical
  bool person_sized = false;

  float height_m() const { return highest_m - lowest_m; }
};

struct Pieces {
  Image<std::int16_t> labels;  // 0: none; else the number of the piece, from 1
  std::vector<Piece> pieces;   // piece i has label i + 1; largest first

  const Piece& Labelled(int label) const { return pieces[static_cast<std::size_t>(label - 1)]; }
};

// Two foreground pixels are connected if they differ little in depth and are either neighbours in a
// row or column, or separated in it only by pixels that are not measured or lie in front of them.
Pieces FindPieces(const DepthImage& depth, const MaskImage& foreground, const Room& room,
                  const CutoutSettings& settings);

// Computes the pieces of the given labels and sorts them by area; pieces that are too small are
// removed together with their labels.
void MeasurePieces(const DepthImage& depth, const Room& room, const CutoutSettings& settings,
                   Pieces& pieces);

}  // namespace vitruvia
