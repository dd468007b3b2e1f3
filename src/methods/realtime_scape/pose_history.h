// What Realtime SCAPE carries from frame to frame.
#pragma once

#include "methods/realtime_scape/bone_visibility.h"

namespace vitruvia::realtime_scape {

struct PoseHistory {
  BodyPose last, before_last;  // after the last frame and the one before
  BoneVisibility visibility;
};

// Of a body that has been in this pose, with every bone observed.
inline PoseHistory AtRest(const BodyPose& pose) { return {pose, pose, {}}; }

// After a frame that ended in `pose`.
inline PoseHistory Advanced(const PoseHistory& before, const Model& model, const BodyPose& pose,
                            const BoneCounts& counts, double observed_share) {
  return {pose, before.last, Advanced(before.visibility, model, counts, observed_share)};
}

}  // namespace vitruvia::realtime_scape
