#include "methods/realtime_scape/facing.h"

#include "tracking/depth_gap.h"

namespace vitruvia::realtime_scape {

FacingCheck::FacingCheck(const Model& model, const PinholeCamera& camera, const Settings& settings)
    : model_(model),
      settings_(settings),
      fitter_(model, camera, settings),
      watch_(settings.facing) {}

std::optional<FitSummary> FacingCheck::Search(const Observation& observation,
                                              const FitSummary& current, const DepthImage& rendered,
                                              const BodyPose& last) {
  if (!watch_.IsDue(GapTo(observation, rendered))) return {};

  fitter_.Compare(observation, current.pose);
  double least_m2 = watch_.GapToBeat(GapTo(observation, fitter_.rendered()));
  std::optional<FitSummary> best;
  // The body has turned where it was, or has been tracked the wrong way round for some time.
  const Rigidd turn = HalfTurn(last.front().rotation, last.front().center);
  const BodyPose away =
      ToPose(model_, FacingAway(model_.skeleton, current.surface.camera_from_rest));
  for (const BodyPose& pose : {RotatedAboutRoot(last, turn.rotation), away}) {
    FitSummary fit = fitter_.Refine(observation, pose, settings_.stopping.first_frame_iterations);
    const double reached_m2 = GapTo(observation, fitter_.rendered());
    if (!fit.solved || reached_m2 >= least_m2) continue;
    least_m2 = reached_m2;
    best = std::move(fit);
  }
  watch_.NoteTrial(best.has_value());
  return best;
}

double FacingCheck::GapTo(const Observation& observation, const DepthImage& rendered) const {
  return SquaredDepthGap_m2(rendered, *observation.depth, settings_.cloud.stride,
                            settings_.cloud.max_depth_m);
}

}  // namespace vitruvia::realtime_scape
