// A tracker's model of its sensor's noise.
#pragma once

#include "config/settings.h"

namespace vitruvia {

// Standard deviations in the form of Nguyen, Izadi & Lovell, 3DIMPVT 2012: along depth, growing
// with the distance, and across the line of sight, where it is a constant angle. All zero: no
// noise.
struct DepthNoise {
  double axial_base_m = 0.0, axial_growth_per_m = 0.0, axial_near_m = 0.0;
  double lateral_rad = 0.0;

  bool IsZero() const {
    return axial_base_m == 0.0 && axial_growth_per_m == 0.0 && lateral_rad == 0.0;
  }
  double AxialDeviation_m(double depth_m) const {
    const double beyond_m = depth_m - axial_near_m;
    return axial_base_m + axial_growth_per_m * beyond_m * beyond_m;
  }
  double LateralDeviation_m(double depth_m) const { return lateral_rad * depth_m; }

  // Variance along a direction (m²) whose cosine with the line of sight is `cosine`:
  // cos² σ_axial² + (1 − cos²) σ_lateral².
  double Variance_m2(double depth_m, double cosine) const {
    const double axial_m = AxialDeviation_m(depth_m), lateral_m = LateralDeviation_m(depth_m);
    const double cosine_squared = cosine * cosine;
    return cosine_squared * axial_m * axial_m + (1.0 - cosine_squared) * lateral_m * lateral_m;
  }

  void Describe(Fields& fields);
};

}  // namespace vitruvia
