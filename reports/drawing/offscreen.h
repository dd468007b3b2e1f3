// A VTK render window that draws into memory, without a display or a window system.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "geometry/image.h"

class vtkRenderWindow;

namespace vitruvia {

using Color = std::array<std::uint8_t, 3>;       // sRGB
using ColorPixel = std::array<std::uint8_t, 4>;  // sRGB and opacity
using ColorImage = Image<ColorPixel>;

class OffscreenWindow {
 public:
  OffscreenWindow(int width, int height);  // pixels; std::runtime_error if OSMesa refuses
  ~OffscreenWindow();
  OffscreenWindow(const OffscreenWindow&) = delete;
  OffscreenWindow& operator=(const OffscreenWindow&) = delete;

  vtkRenderWindow& vtk();
  void Resize(int width, int height);
  // Makes the window's context the current one (another part of the program may have taken its
  // place) and draws.
  void Draw();
  ColorImage DrawAndRead();  // top row first

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

std::string EncodePng(const ColorImage& image);
std::string DataUri(const std::string& png);  // base64

}  // namespace vitruvia
