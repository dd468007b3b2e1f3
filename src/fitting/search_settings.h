// Settings of a pose search that are common to surfaces and depth frames.
#pragma once

#include "config/settings.h"
#include "fitting/fit_target.h"

namespace vitruvia {

struct PoseSearchSettings {
  int headings = 16;
  int coarse_vertices = 300, fine_vertices = 900;
  double angle_deviation_deg = 40.0;
  double near_m = 0.03, far_m = 0.2;
  double near_growth_per_m = 0.0012;
  double least_explained = 0.9;

  // Limits of the verdict on a depth frame whose person is that far away.
  NearFar LimitsAt(double depth_m) const {
    return {near_m + near_growth_per_m * depth_m * depth_m, far_m};
  }

  void Describe(Fields& fields);
};

}  // namespace vitruvia
