// Cross-sections of limbs: rings of points of a given girth.
#pragma once

#include <array>

#include <Eigen/Core>

#include "synth/bodies/mannequin_cage.h"
#include "synth/bodies/mannequin_tables.h"

namespace vitruvia::mannequin {

inline constexpr double kCentimetre = 0.01;

using Section = Eigen::Matrix<double, kRingPoints, 2>;  // metres from its centre, in its plane

// A regular hexagon with a radius for each corner, scaled along the plane's axes.
struct SectionShape {
  std::array<double, kRingPoints> radii{1, 1, 1, 1, 1, 1};
  double width = 1.0, depth = 1.0;
};

// The length of the closed uniform cubic B-spline of the points, metres, to which a ring of the
// refined surface converges.
double GirthOf(const Section& points);

// Point k lies in direction `first_deg` + k `step_deg` before the stretch.
Section SectionOfGirth(const SectionShape& shape, double first_deg, double step_deg,
                       double girth_m);

double At(const Girth& girth, double girth_score);  // metres
Girth Scaled(const Girth& girth, double factor);
Girth Between(const Girth& a, const Girth& b, double share_of_b);

}  // namespace vitruvia::mannequin
