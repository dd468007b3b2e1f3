// Text and colours inside HTML.
#pragma once

#include <string>

#include <fmt/format.h>

#include "core/markup.h"
#include "reports/drawing/color_image.h"

namespace vitruvia {

inline std::string CssColor(const Color& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

}  // namespace vitruvia
