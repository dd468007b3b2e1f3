// Escapes from local minima of a fit to a depth frame: headings of the body, bends of the trunk and
// poses of single limbs are tried one after the other and evaluated by rendering, without
// gradients.
#pragma once

#include <vector>

#include "body/start_poses.h"
#include "fitting/depth_target.h"
#include "fitting/pose_fit.h"

namespace vitruvia {

struct JudgedPose {
  BodyState state;
  double image_distance_m = 0.0;  // DepthTarget::ImageDistance
};

class PoseVariation {
 public:
  // World frame of the target: y is vertical. All must outlive the variation.
  PoseVariation(PoseFit& fit, DepthTarget& target, double far_m);

  JudgedPose Judged(const BodyState& state);
  JudgedPose WithTrunk(JudgedPose pose);
  JudgedPose WithLegs(JudgedPose pose);
  JudgedPose WithArms(JudgedPose pose);
  JudgedPose Varied(const BodyState& state);  // trunk, legs, arms

 private:
  JudgedPose Better(JudgedPose pose, const std::vector<BodyState>& variants);
  std::vector<BodyState> Centered(std::vector<BodyState> states);

  PoseFit& fit_;
  DepthTarget& target_;
  double far_m_;
  PosedBody posed_;
};

// The state with one side's angles first_angle … end_angle − 1 (its arm or leg) replaced.
BodyState WithLimb(BodyState state, Side side, const SideAngles& angles_deg, int first_angle,
                   int end_angle);

}  // namespace vitruvia
