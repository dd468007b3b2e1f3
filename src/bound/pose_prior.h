// Prior knowledge of a pose before a frame is observed.
#pragma once

#include "config/settings.h"

namespace vitruvia {

// Independent standard deviations of the unknowns about the truth.
struct PosePrior {
  double rotation_deg = 60.0;  // of each bone relative to its parent
  double position_m = 1.0;     // of the body

  void Describe(Fields& fields);
};

}  // namespace vitruvia
