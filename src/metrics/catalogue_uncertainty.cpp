#include "metrics/catalogue_entries.h"

namespace vitruvia {

using enum Place;

std::vector<Metric> UncertaintyMetrics() {
  return {
      {.key = "covariances_given",
       .label = "visible joints with a covariance",
       .unit = "%",
       .scale = 1e2,
       .decimals = 1,
       .better = Better::kHigher,
       .definition = "Share of the visible joints, over all frames, for which the tracker gives a "
                     "covariance.",
       .formula = "#{covariance given} / #{j visible}",
       .hidden_and_lost = kSeenJointsOnly},
      {.key = "coverage_68",
       .label = "coverage of the 68 % regions",
       .unit = "%",
       .scale = 1e2,
       .decimals = 1,
       .shown_in = {kVariantTable, kTerminal},
       .definition = "Share of the visible joints with a covariance that lie within the ellipsoid "
                     "that should hold 68 % of them.",
       .formula = "mean_{f, j visible} [eᵀ Σ⁻¹ e ≤ 3.506], e = ĵ_fj − j_fj, Σ the covariance given",
       .averaged_over = kOverJoints,
       .hidden_and_lost = kSeenJointsOnly},
      {.key = "coverage_95",
       .label = "coverage of the 95 % regions",
       .unit = "%",
       .scale = 1e2,
       .decimals = 1,
       .shown_in = {kVariantTable, kTerminal},
       .definition = "Share of the visible joints with a covariance that lie within the ellipsoid "
                     "that should hold 95 % of them.",
       .formula = "mean_{f, j visible} [eᵀ Σ⁻¹ e ≤ 7.815], e = ĵ_fj − j_fj, Σ the covariance given",
       .averaged_over = kOverJoints,
       .hidden_and_lost = kSeenJointsOnly},
      {.key = "negative_log_likelihood",
       .label = "negative log-likelihood of the joints",
       .unit = "nats",
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kVariantTable},
       .definition = "−log of the Gaussian density, in 1/m³, that the tracker gave to the true "
                     "place of a joint: the mean over the visible joints with a covariance.",
       .formula = "mean_{f, j visible} ½ (eᵀ Σ⁻¹ e + ln det 2πΣ), e = ĵ_fj − j_fj",
       .averaged_over = kOverJoints,
       .hidden_and_lost = kSeenJointsOnly},
      {.key = "unreliable_told",
       .label = "joints off by more than 5 cm, told",
       .unit = "%",
       .scale = 1e2,
       .decimals = 1,
       .better = Better::kHigher,
       .shown_in = {kVariantTable},
       .definition = "Share of the visible joints off by more than 5 cm that the tracker called "
                     "unreliable.",
       .formula = "#{‖e‖ > 5 cm, called unreliable} / #{‖e‖ > 5 cm}",
       .hidden_and_lost = kSeenJointsOnly},
      {.key = "unreliable_false_alarms",
       .label = "joints within 5 cm, called unreliable",
       .unit = "%",
       .scale = 1e2,
       .decimals = 1,
       .better = Better::kLower,
       .shown_in = {kVariantTable},
       .definition = "Share of the visible joints within 5 cm that the tracker called unreliable.",
       .formula = "#{‖e‖ ≤ 5 cm, called unreliable} / #{‖e‖ ≤ 5 cm}",
       .hidden_and_lost = kSeenJointsOnly},
  };
}

std::vector<Metric> BoundMetrics() {
  return {
      {.key = "joint_bound_rms_visible_m",
       .label = "bound of the joint error",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .shown_in = {kSummaryTable, kVariantTable, kTerminal},
       .definition =
           "Cramér–Rao bound: the smallest error of visible joints that an unbiased estimate from "
           "one frame alone can have, given the body's shape, the sensor's noise at each pixel and "
           "a weak prior; root mean square over visible joints and frames. Trackers with memory "
           "may pass it.",
       .formula = "√ mean_{f, j visible} tr C_fj, C from the inverse of I(θ)",
       .averaged_over = kOverJoints,
       .hidden_and_lost = kSeenJointsOnly},
      {.key = "joint_error_rms_visible_m",
       .label = "joint error, visible joints, root mean square",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kVariantTable},
       .definition = "Root mean square of the joint error over the visible joints and the frames "
                     "of joint_bound_rms_visible_m.",
       .formula = "√ mean_{f, j visible} ‖ĵ_fj − j_fj‖²",
       .averaged_over = kOverJoints,
       .hidden_and_lost = kSeenJointsOnly},
      {.key = "joint_efficiency",
       .label = "efficiency of the joints",
       .decimals = 3,
       .better = Better::kHigher,
       .shown_in = {kSummaryTable, kVariantTable, kTerminal},
       .definition = "joint_bound_rms_visible_m / joint_error_rms_visible_m: 1 is what a single "
                     "frame allows.",
       .formula = "joint_bound_rms_visible_m / joint_error_rms_visible_m",
       .hidden_and_lost = kSeenJointsOnly},
  };
}

}  // namespace vitruvia
