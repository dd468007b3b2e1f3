// A contact sheet of depth images of several frames.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/image.h"

namespace vitruvia {

struct DepthTile {
  std::string label;
  DepthImage depth;  // all tiles have one size
  MaskImage person;  // shown in colours of depth; all else is grey
};

// Writes a PNG file. The colours of all tiles have one scale, over the person's depths.
void WriteDepthSheet(const std::filesystem::path& png, const std::vector<DepthTile>& tiles);

}  // namespace vitruvia
