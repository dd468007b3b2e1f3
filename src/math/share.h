// Shares of counts.
#pragma once

#include <concepts>

namespace vitruvia {

// part / whole, or `of_nothing` if the whole is 0.
double ShareOr(std::integral auto part, std::integral auto whole, double of_nothing) {
  return whole == 0 ? of_nothing : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace vitruvia
