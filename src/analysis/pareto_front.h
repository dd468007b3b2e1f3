// What is worth choosing where two costs are to be low.
#pragma once

#include <span>
#include <vector>

namespace vitruvia {

struct Costs {
  double first = 0.0, second = 0.0;
};

// Whether each is on the front: no other is at least as low in both and lower in one. Equal ones
// are on it together; one with a cost that is no number is not.
std::vector<bool> ParetoFront(std::span<const Costs> costs);

}  // namespace vitruvia
