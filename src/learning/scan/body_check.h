// Checks that a scanned surface is one complete body, from its components and holes.
#pragma once

#include "learning/scan/scan_surface.h"

namespace vitruvia {

struct BodyCheckSettings {
  double min_area_m2 = 0.5;
  double second_body_share = 0.3;
  double head_reach_m = 0.12;
  double max_head_hole_m2 = 0.0065;

  void Describe(Fields& fields);
};

// DataError saying what is wrong: no body (too little surface), more than one (a second component
// that is too large), or a hole for a head (a large opening within head_reach_m of the top).
void RequireOneWholeBody(const ScanSurface& surface, const BodyCheckSettings& settings);

}  // namespace vitruvia
