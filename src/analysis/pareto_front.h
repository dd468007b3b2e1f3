// The Pareto front of two costs that are to be minimised.
#pragma once

#include <span>
#include <vector>

namespace vitruvia {

struct Costs {
  double first = 0.0, second = 0.0;
};

// Whether each is on the front, that is, whether no other is at most as high in both costs and
// lower in one. Equal ones are on the front together; one with a NaN cost is not.
std::vector<bool> ParetoFront(std::span<const Costs> costs);

}  // namespace vitruvia
