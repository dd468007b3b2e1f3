#include "analysis/pareto_front.h"

#include <algorithm>
#include <cmath>

namespace vitruvia {
namespace {

bool IsNumber(const Costs& c) { return !std::isnan(c.first) && !std::isnan(c.second); }

bool Dominates(const Costs& a, const Costs& b) {
  return a.first <= b.first && a.second <= b.second && (a.first < b.first || a.second < b.second);
}

}  // namespace

std::vector<bool> ParetoFront(std::span<const Costs> costs) {
  std::vector<bool> front;
  for (const Costs& candidate : costs) {
    front.push_back(IsNumber(candidate) &&
                    std::none_of(costs.begin(), costs.end(),
                                 [&](const Costs& other) { return Dominates(other, candidate); }));
  }
  return front;
}

}  // namespace vitruvia
