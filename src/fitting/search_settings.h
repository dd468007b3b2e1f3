// Settings of a pose search that are common to surfaces and depth frames.
#pragma once

#include "config/settings.h"

namespace vitruvia {

struct PoseSearchSettings {
  int headings = 16;
  int coarse_vertices = 300, fine_vertices = 900;
  double angle_deviation_deg = 40.0;
  double near_m = 0.03, far_m = 0.2;
  double least_explained = 0.9;

  void Describe(Fields& fields);
};

}  // namespace vitruvia
