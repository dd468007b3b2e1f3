// How settings are put into words, alike in errors and in explanations.
#pragma once

#include <span>
#include <string>

#include "config/settings.h"

namespace vitruvia {

// How stored data spell infinite numbers.
inline constexpr const char* kInfinityText = "Infinity";
inline constexpr const char* kMinusInfinityText = "-Infinity";

std::string Range(const About& about);  // "0 … 2", "≥ 0", or "" where there is none
std::string JoinedPath(const std::string& path, const std::string& key);
std::string Quoted(std::span<const char* const> names);

}  // namespace vitruvia
