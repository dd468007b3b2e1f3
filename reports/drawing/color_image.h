// Pictures of coloured pixels, and their files.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/image.h"

namespace vitruvia {

using Color = std::array<std::uint8_t, 3>;       // sRGB
using ColorPixel = std::array<std::uint8_t, 4>;  // sRGB and opacity
using ColorImage = Image<ColorPixel>;

// A PNG file's content; without opacity where all pixels are opaque.
std::string EncodePng(const ColorImage& image);
// DataError if the file is not a PNG.
ColorImage ReadPng(const std::filesystem::path& file);

std::string Base64(const void* bytes, std::size_t count);
std::string DataUri(const std::string& png);

// A picture with transparent parts laid on white paper.
ColorImage OnWhite(ColorImage image);

// A picture that goes into several files and is encoded once.
struct Picture {
  Picture() = default;
  explicit Picture(ColorImage drawn) : image(std::move(drawn)), png(EncodePng(image)) {}

  ColorImage image;
  std::string png;
};

}  // namespace vitruvia
