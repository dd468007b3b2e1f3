// Text for settings, shared by error messages and `vitruvia explain`.
#pragma once

#include <span>
#include <string>

#include "config/settings.h"

namespace vitruvia {

// Infinite numbers in stored data.
inline constexpr const char* kInfinityText = "Infinity";
inline constexpr const char* kMinusInfinityText = "-Infinity";

std::string Range(const About& about);  // "0 … 2", "≥ 0", or "" where there is none
std::string JoinedPath(const std::string& path, const std::string& key);
std::string Quoted(std::span<const char* const> names);

}  // namespace vitruvia
