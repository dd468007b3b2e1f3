// The state that Realtime SCAPE keeps between frames.
#pragma once

#include "methods/realtime_scape/bone_visibility.h"

namespace vitruvia::realtime_scape {

struct PoseHistory {
  BodyPose last, before_last;  // poses of the last frame and of the frame before it
  BoneVisibility visibility;
};

// History of a body at rest in this pose, with every bone observed.
inline PoseHistory AtRest(const BodyPose& pose) { return {pose, pose, {}}; }

// After a frame that ended in `pose`.
inline PoseHistory Advanced(const PoseHistory& before, const Model& model, const BodyPose& pose,
                            const BoneCounts& counts, double observed_share) {
  return {pose, before.last, Advanced(before.visibility, model, counts, observed_share)};
}

}  // namespace vitruvia::realtime_scape
