// The energy terms that Dynamic minimises and reports (paper B, eqs. 6 to 9).
#pragma once

#include <array>

namespace vitruvia::dynamic {

// Each value is weighted as minimised and taken before the frame's last step of its kind. Every
// frame reports every term. A term that the frame did not evaluate is 0: all terms if the frame
// holds no measurement, and the shape's terms if no shape step is made. The damping λ is not an
// energy: it penalises the step, which is 0 where the terms are evaluated.
enum EnergyTerm {
  kDataTerm,             // Σ r_i² of the pose step, m² (eq. 6)
  kDefaultPoseTerm,      // γ Σ_k D_k θ_k² of the pose step's prior
  kShapeDataTerm,        // Σ r_i² of the shape step, m² (eq. 9)
  kShapeMagnitudeTerm,   // λ_d Σ ‖ω_i‖² (eq. 9)
  kShapeSmoothnessTerm,  // λ_s Σ_i Σ_{j∈N(i)} ‖ω_i − ω_j‖² (eq. 9)
  kEnergyTermCount
};
inline constexpr std::array<const char*, kEnergyTermCount> kEnergyTermNames = {
    "data", "default_pose", "shape_data", "shape_magnitude", "shape_smoothness"};

// By EnergyTerm.
using Energies = std::array<double, kEnergyTermCount>;

}  // namespace vitruvia::dynamic
