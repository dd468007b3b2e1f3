// Finds a limb that has moved away from its predicted place.
#pragma once

#include <optional>
#include <vector>

#include "methods/realtime_scape/pose_fitter.h"

namespace vitruvia::realtime_scape {

// The two bones of an arm or leg and the one that hangs from them.
struct Limb {
  BoneId upper, lower, end;
  // Axis of the hinge between upper and lower bone, rest pose; the limb bends by a positive angle
  // about it.
  Vector3d hinge;
};
const std::array<Limb, 4>& Limbs();

// The pose with the limb's lower end (wrist, ankle) at `target` (camera frame), or as near to it as
// the limb reaches, bent in the direction of its hinge. `swivel_rad` turns the limb about the line
// from its root to the target.
BodyPose WithLimbAt(const Model& model, const BodyPose& pose, const Limb& limb,
                    const Vector3d& target, double swivel_rad);

class LimbFinder {
 public:
  LimbFinder(const Model& model, const PinholeCamera& camera, const Settings& settings);

  // If enough of the frame is not explained by `current` (`unexplained`: indices of the cloud's
  // points), hypotheses place the end of each limb on unexplained points and are scored by their
  // bones' axes; the best ones are refined. Nothing if none of them is clearly better.
  std::optional<FitSummary> Search(const Observation& observation, const FitSummary& current,
                                   const std::vector<int>& unexplained);

 private:
  struct Hypothesis {
    BodyPose pose;
    double score;
  };

  void CollectUnexplained(const Observation& observation, const std::vector<int>& unexplained);
  double UnexplainedArea_m2() const;
  std::vector<Vector3d> SpreadTargets(const Vector3d& root) const;
  std::vector<Hypothesis> Hypotheses(const Observation& observation, const BodyPose& pose) const;
  double Score(const Observation& observation, const BodyPose& pose, const Limb& limb) const;

  const Model& model_;
  PinholeCamera camera_;
  Settings settings_;
  PoseFitter fitter_;
  std::array<double, kBoneCount> radius_m_;  // mean distance of skin and axis
  std::vector<Vector3d> points_;             // unexplained, camera frame
};

}  // namespace vitruvia::realtime_scape
