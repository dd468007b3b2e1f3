#include "methods/realtime_scape/facing.h"

#include <algorithm>

#include "tracking/depth_gap.h"

namespace vitruvia::realtime_scape {

BodyPose FacingAway(const Model& model, const BodyPose& pose) {
  const Vector3d half_turn(-1.0, 1.0, -1.0);  // about y
  BodyPose away;
  for (int bone = 0; bone < kBoneCount; ++bone) {
    const int mirror = Bones()[bone].mirror;
    const auto& joints = model.skeleton.joints;
    const Vector3d from_joint = half_turn.cwiseProduct(model.rest_centers[bone] - joints[bone]);
    const Vector3d rest_point = joints[mirror] + from_joint;
    away[bone].rotation = pose[mirror].rotation * half_turn.asDiagonal();
    away[bone].center =
        pose[mirror].center + pose[mirror].rotation * (rest_point - model.rest_centers[mirror]);
  }
  return away;
}

FacingCheck::FacingCheck(const Model& model, const PinholeCamera& camera, const Settings& settings)
    : model_(model),
      settings_(settings),
      fitter_(model, camera, settings),
      pause_(settings.facing.pause) {}

std::optional<FitSummary> FacingCheck::Search(const Observation& observation,
                                              const FitSummary& current, const DepthImage& rendered,
                                              const BodyPose& last) {
  if (!IsDue(GapTo(observation, rendered))) return {};

  const double margin_m2 = settings_.facing.margin_m * settings_.facing.margin_m;
  fitter_.Compare(observation, current.pose);
  const double current_m2 = GapTo(observation, fitter_.rendered());
  double least_m2 =
      std::min(current_m2 - margin_m2, (1.0 - settings_.facing.least_decrease) * current_m2);
  std::optional<FitSummary> best;
  // The body has turned where it was, or has been tracked the wrong way round for some time.
  const Matrix3<double> about_trunk = last.front().rotation *
                                      Vector3d(-1.0, 1.0, -1.0).asDiagonal() *
                                      last.front().rotation.transpose();
  for (const BodyPose& pose :
       {RotatedAboutRoot(last, about_trunk), FacingAway(model_, current.pose)}) {
    FitSummary fit = fitter_.Refine(observation, pose, settings_.stopping.first_frame_iterations);
    const double reached_m2 = GapTo(observation, fitter_.rendered());
    if (!fit.solved || reached_m2 >= least_m2) continue;
    least_m2 = reached_m2;
    best = std::move(fit);
  }
  if (best) pause_.Reset();
  return best;
}

// Also follows the usual gap.
bool FacingCheck::IsDue(double gap_m2) {
  constexpr double kFollow = 0.05;  // share of a new gap in the usual one
  if (usual_m2_ < 0.0) usual_m2_ = gap_m2;
  const double margin_m2 = settings_.facing.margin_m * settings_.facing.margin_m;
  pause_.NextFrame();
  if (gap_m2 <= usual_m2_ + margin_m2) {
    usual_m2_ += kFollow * (gap_m2 - usual_m2_);
    pause_.Reset();
    return false;
  }
  if (!pause_.is_over()) return false;
  pause_.Begin();
  return true;
}

double FacingCheck::GapTo(const Observation& observation, const DepthImage& rendered) const {
  return SquaredDepthGap_m2(rendered, *observation.depth, settings_.cloud.stride,
                            settings_.cloud.max_depth_m);
}

}  // namespace vitruvia::realtime_scape
