// The terms of the energy (paper A, eq. 7) by name and weight. A new term is one more file in this
// folder, one more enumerator here and one more entry of the list in energy_terms.cpp.
#pragma once

#include <array>

#include "config/settings.h"

namespace vitruvia::realtime_scape {

enum class EnergyTerm {
  kFit,  // this and the next three: paper A, eq. 7
  kJoint,
  kInertia,
  kAxis,
  kFreeSpace,  // this and those below: ours
  kLimit,
  kPrior,
  kCount
};
inline constexpr auto kEnergyTermCount = static_cast<std::size_t>(EnergyTerm::kCount);

// The term's name in results.
const char* Name(EnergyTerm term);

// One weight for each term (α of eq. 7). A term's setting is its name with "_weight". The fit term
// has no such weight: the weights of its two kinds of rows are in the section "fit".
struct TermWeights {
  TermWeights();  // the defaults of the list

  double& operator[](EnergyTerm term) { return values[static_cast<std::size_t>(term)]; }
  double operator[](EnergyTerm term) const { return values[static_cast<std::size_t>(term)]; }
  void Describe(Fields& fields);

  std::array<double, kEnergyTermCount> values{};
};

// The energy of each term, weighted as it is minimised.
using Energies = std::array<double, kEnergyTermCount>;

}  // namespace vitruvia::realtime_scape
