// Catalogue entries of errors of joints and motion.
#include "metrics/catalogue_entries.h"

namespace vitruvia {
namespace {
using enum Place;
}  // namespace

std::vector<Metric> JointErrorMetrics() {
  return {
      {.key = "joint_error_mean_m",
       .label = "mean joint error",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kSummaryTable, kVariantTable, kComparison, kTerminal, kGate, kSpeedPlot,
                    kHistoryPlot},
       .definition =
           "Mean distance between estimated and true joints, over all joints and frames whose "
           "truth is known. In a series per frame it is the mean over the joints of that frame.",
       .formula = "mean_{f,j} ‖ĵ_fj − j_fj‖",
       .averaged_over = kOverJoints,
       .hidden_and_lost = kJointsCount},
      {.key = "joint_error_mean_visible_m",
       .label = "mean joint error, visible joints",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "joint_error_mean_m over the joints that the camera sees.",
       .formula = "mean_{f, j visible} ‖ĵ_fj − j_fj‖",
       .averaged_over = kOverJoints,
       .hidden_and_lost = kSeenJointsOnly},
      {.key = "joint_error_mean_hidden_m",
       .label = "mean joint error, hidden joints",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "joint_error_mean_m over the joints that the camera does not see.",
       .formula = "mean_{f, j hidden} ‖ĵ_fj − j_fj‖",
       .averaged_over = kOverJoints,
       .hidden_and_lost = kHiddenJointsOnly},
      {.key = "joint_error_max_m",
       .label = "maximum joint error",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kGate},
       .definition = "Maximum distance between an estimated and a true joint. In a series per "
                     "frame it is the maximum over the joints of that frame.",
       .formula = "max_{f,j} ‖ĵ_fj − j_fj‖",
       .hidden_and_lost = kJointsCount},
      {.key = "joint_error_mean_less_offset_m",
       .label = "mean joint error, less each joint's mean offset",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "joint_error_mean_m after the mean offset of each joint over the frames is "
                     "subtracted, for methods and recordings that define their joints "
                     "differently.",
       .formula = "mean_{f,j} ‖(ĵ_fj − j_fj) − mean_g (ĵ_gj − j_gj)‖",
       .averaged_over = kOverJoints,
       .hidden_and_lost = kJointsCount},
      {.key = "joints_within_2cm",
       .label = "joints within 2 cm",
       .unit = "%",
       .scale = 1e2,
       .decimals = 2,
       .better = Better::kHigher,
       .definition = "Share of the joints, over all frames, whose estimate lies within 2 cm of the "
                     "truth.",
       .formula = "mean_{f,j} [‖ĵ_fj − j_fj‖ ≤ 0.02 m]",
       .averaged_over = kOverJoints,
       .hidden_and_lost = kJointsCount},
      {.key = "joints_within_5cm",
       .label = "joints within 5 cm",
       .unit = "%",
       .scale = 1e2,
       .decimals = 2,
       .better = Better::kHigher,
       .definition = "Share of the joints, over all frames, whose estimate lies within 5 cm of the "
                     "truth.",
       .formula = "mean_{f,j} [‖ĵ_fj − j_fj‖ ≤ 0.05 m]",
       .averaged_over = kOverJoints,
       .hidden_and_lost = kJointsCount},
      {.key = "joints_within_10cm",
       .label = "joints within 10 cm",
       .unit = "%",
       .scale = 1e2,
       .decimals = 2,
       .better = Better::kHigher,
       .shown_in = {kSummaryTable, kVariantTable, kComparison, kTerminal, kIndexPage, kGate},
       .definition = "Share of the joints, over all frames, whose estimate lies within 10 cm of "
                     "the truth (paper A, section 7.1).",
       .formula = "mean_{f,j} [‖ĵ_fj − j_fj‖ ≤ 0.10 m]",
       .averaged_over = kOverJoints,
       .hidden_and_lost = kJointsCount},
      {.key = "joints_within_10cm_less_offset",
       .label = "joints within 10 cm, less each joint's mean offset",
       .unit = "%",
       .scale = 1e2,
       .decimals = 2,
       .better = Better::kHigher,
       .definition =
           "joints_within_10cm after the mean offset of each joint over the frames is subtracted, "
           "for recordings that define their joints differently (paper B on EVAL).",
       .formula = "mean_{f,j} [‖(ĵ_fj − j_fj) − mean_g (ĵ_gj − j_gj)‖ ≤ 0.10 m]",
       .averaged_over = kOverJoints,
       .hidden_and_lost = kJointsCount},
      {.key = "limb_losses",
       .label = "losses of a limb that is seen",
       .better = Better::kLower,
       .definition =
           "Number of stretches of frames in which a limb is lost: its elbow or wrist (knee or "
           "ankle) is more than 10 cm off. Stretches in which the camera never sees it are left "
           "out, and so are those that the end of the run cuts short before the limb was seen in "
           "more than 10 frames. Seen: a fifth of the vertices of forearm and hand (shin and foot) "
           "is visible. Absent unless the sequence has a true surface, its own subject and true "
           "joints of all limbs.",
       .formula = "Σ_limbs number of such stretches",
       .hidden_and_lost =
           "A limb out of sight does not count; frames that the tracker calls lost "
           "count like all others. Frames without the truth of a limb are left out."},
      {.key = "limbs_found_within_10_frames",
       .label = "lost limbs found within 10 frames",
       .unit = "%",
       .scale = 1e2,
       .decimals = 1,
       .better = Better::kHigher,
       .definition = "Share of limb_losses that hold at most 10 frames in which the camera sees "
                     "the limb. A stretch of one frame counts like a long one, and so does one "
                     "that ends while the limb is hidden. Absent if limb_losses is 0.",
       .formula = "losses with at most 10 seen frames / limb_losses",
       .hidden_and_lost = "As for limb_losses."},
      {.key = "joint_auc_30cm",
       .label = "joint accuracy, area under the curve to 30 cm",
       .decimals = 4,
       .better = Better::kHigher,
       .definition =
           "Share of joints within a threshold, averaged over the thresholds from 0 to 30 cm.",
       .formula = "mean_t mean_{f,j} [‖ĵ_fj − j_fj‖ ≤ t], t = 0, 0.01, …, 0.30 m",
       .averaged_over = kOverJoints,
       .hidden_and_lost = kJointsCount},
  };
}

std::vector<Metric> MotionErrors() {
  return {
      {.key = "twist_rms_deg",
       .label = "twist error, RMS",
       .unit = "°",
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kComparison, kGate, kPictureNote},
       .definition = "Root mean square over frames and limbs of the rotation of the estimate "
                     "against the truth about the limb's own axis.",
       .formula = "√(mean_{f,b} twist(R_fbᵀ R̂_fb)²)",
       .averaged_over = "the frames and the eight limb bones together",
       .hidden_and_lost = kAllCount},
      {.key = "jitter_rms_rad_s2",
       .label = "jitter, RMS",
       .unit = "rad/s²",
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kComparison, kGate, kPictureNote},
       .definition = "Root mean square over bones and frames of the difference between the "
                     "estimated and the true angular acceleration.",
       .formula = "√(mean_{f,b} ‖α̂_fb − α_fb‖²), α_f = (ω_f − ω_{f−1}) fps",
       .averaged_over = "the frames from the third and all bones together",
       .hidden_and_lost = kAllCount},
  };
}

}  // namespace vitruvia
