#include "methods/realtime_scape/limb_finder.h"

namespace vitruvia::realtime_scape {

LimbBody LimbBodyOf(const Model& model) {
  return vitruvia::LimbBodyOf(model.skeleton, model.rest_centers, model.rest_vertices,
                              model.weights);
}

LimbFinder::LimbFinder(const Model& model, const PinholeCamera& camera, const Settings& settings)
    : settings_(settings),
      search_(LimbBodyOf(model), camera, settings.cloud.stride, settings.fit.near_surface_m,
              settings.limbs),
      fitter_(model, camera, settings) {}

std::optional<FitSummary> LimbFinder::Search(const Observation& observation,
                                             const FitSummary& current,
                                             const std::vector<int>& unexplained) {
  const std::vector<BodyPose> hypotheses =
      search_.Hypotheses(*observation.depth, observation.cloud.points, unexplained, current.pose);
  if (hypotheses.empty()) return {};
  std::optional<FitSummary> best;
  double least_score = fitter_.Compare(observation, current.pose).agreement.score();
  for (const BodyPose& hypothesis : hypotheses) {
    FitSummary fit = fitter_.Refine(observation, hypothesis, settings_.stopping.max_iterations);
    if (!fit.solved || fit.agreement.score() < least_score + settings_.limbs.margin) continue;
    least_score = fit.agreement.score();
    best = std::move(fit);
  }
  return best;
}

}  // namespace vitruvia::realtime_scape
