// What is known of a pose before a frame is seen.
#pragma once

#include "config/settings.h"

namespace vitruvia {

// Each unknown by itself, round the truth.
struct PosePrior {
  double rotation_deg = 60.0;  // of each bone against its parent
  double position_m = 1.0;     // of the body

  void Describe(Fields& fields);
};

}  // namespace vitruvia
