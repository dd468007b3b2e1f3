#include "config/settings_text.h"

#include <cmath>

#include <fmt/format.h>

namespace vitruvia {

std::string Range(const About& about) {
  const bool has_min = std::isfinite(about.min), has_max = std::isfinite(about.max);
  if (has_min && has_max) return fmt::format("{:g} … {:g}", about.min, about.max);
  if (has_min) return fmt::format("≥ {:g}", about.min);
  if (has_max) return fmt::format("≤ {:g}", about.max);
  return "";
}

std::string JoinedPath(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

std::string Quoted(std::span<const char* const> names) {
  std::string text;
  for (const char* name : names) text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", name);
  return text;
}

const char* Name(Origin origin) {
  switch (origin) {
    case Origin::kPaper:
      return "paper";
    case Origin::kGuessed:
      return "guessed";
    case Origin::kTuned:
      return "tuned";
    case Origin::kInput:
      return "input";
  }
  return "";
}

}  // namespace vitruvia
