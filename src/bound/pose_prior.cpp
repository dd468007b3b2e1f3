#include "bound/pose_prior.h"

namespace vitruvia {

void PosePrior::Describe(Fields& f) {
  f.Number("rotation_deg", rotation_deg,
           {.meaning = "standard deviation of each bone's rotation relative to its parent, before "
                       "the frame is observed",
            .unit = "deg",
            .min = 0.1,
            .max = 1e4,
            .origin = Origin::kGuessed,
            .source = "weak: a joint's range of motion"});
  f.Number("position_m", position_m,
           {.meaning = "standard deviation of the body's position before the frame is observed",
            .unit = "m",
            .min = 1e-3,
            .max = 1e3,
            .origin = Origin::kGuessed,
            .source = "weak: somewhere in the room"});
}

}  // namespace vitruvia
