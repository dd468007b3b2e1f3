// The entries of the metric catalogue (catalogue.h), by what they measure.
#include "metrics/catalogue.h"

namespace vitruvia {
namespace {

using enum Place;

// Which run it is.
std::vector<Metric> IdentityColumns() {
  return {
      {.key = "run_id",
       .label = "run",
       .shown_in = {kSummaryTable},
       .definition = "Name of the run: variant, scene, method, seed and a hash of its resolved "
                     "configuration."},
      {.key = "variant",
       .label = "variant",
       .shown_in = {kSummaryTable},
       .definition = "Name of the overrides that the run was made with."},
      {.key = "scene",
       .label = "scene",
       .shown_in = {kSummaryTable},
       .definition = "Name of the scene, recording or person that was tracked, scanned or fitted."},
      {.key = "method",
       .label = "method",
       .shown_in = {kSummaryTable},
       .definition = "Name of the method that was run."},
      {.key = "seed",
       .label = "seed",
       .shown_in = {kSummaryTable},
       .definition = "Seed of the scene's random numbers."},
      {.key = "repeat",
       .label = "repeat",
       .definition =
           "Number of the repetition, from 1, of a run that is carried out several times."},
      {.key = "case",
       .label = "case",
       .definition = "Name of the variant, as stored by the score."},
      {.key = "not_scored",
       .label = "not scored",
       .definition = "What could not be measured because the sequence has no truth for it."},
  };
}

// Frames, and how many of them failed.
std::vector<Metric> FrameCounts() {
  return {
      {.key = "frames",
       .label = "frames",
       .shown_in = {kSummaryTable, kIndexPage},
       .definition = "Number of tracked frames."},
      {.key = "frames_failed",
       .label = "failed frames",
       .better = Better::kLower,
       .shown_in = {kSummaryTable, kVariantTable, kComparison, kTerminal, kIndexPage, kGate},
       .definition = "Number of frames for which the tracker reported a failure."},
      {.key = "failed",
       .label = "failed",
       .better = Better::kLower,
       .definition = "Per frame: 1 if the tracker reported a failure, else 0."},
      {.key = "frames_lost",
       .label = "lost frames by truth",
       .decimals = 1,
       .better = Better::kLower,
       .shown_in = {kComparison, kTerminal, kGate},
       .definition = "Number of frames in which the tracker reported a failure or the mean L2 "
                     "error of the visible surface is above 5 cm."},
      {.key = "frames_to_recover",
       .label = "frames to recover",
       .definition = "Length of the longest stretch of lost frames; -1 if the subject was still "
                     "lost in the last frame."},
      {.key = "frames_to_notice",
       .label = "frames until a loss is told",
       .better = Better::kLower,
       .definition = "The most consecutive frames in which the mean error of the visible surface "
                     "is above 5 cm and the tracker does not say that it is lost."},
      {.key = "non_finite",
       .label = "values that are not finite",
       .better = Better::kLower,
       .shown_in = {kGate},
       .definition = "Number of stored values per frame that are NaN or infinite, without joint "
                     "errors of frames whose true joints are unknown."},
  };
}

// Distance of corresponding surface points.
std::vector<Metric> CorrespondingPointErrors() {
  return {
      {.key = "l2_mean_m",
       .label = "mean L2 error",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kSummaryTable, kGate, kPictureNote, kHistoryPlot},
       .definition = "Distance between corresponding points of the estimated and the true surface: "
                     "the mean over the vertices. In a summary row it is the mean over all frames, "
                     "failed ones included."},
      {.key = "l2_max_m",
       .label = "maximum L2 error",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 1,
       .better = Better::kLower,
       .shown_in = {kGate},
       .definition =
           "Distance between corresponding points of the estimated and the true surface: the "
           "maximum over the vertices. In a summary row it is the maximum over all frames."},
      {.key = "l2_mean_of_diagonal",
       .label = "mean L2 error / diagonal",
       .decimals = 5,
       .better = Better::kLower,
       .shown_in = {kSummaryTable, kVariantTable, kComparison, kTerminal, kIndexPage, kSpeedPlot},
       .definition = "l2_mean_m divided by diagonal_m, as paper A prints it in figure 11."},
      {.key = "l2_max_of_diagonal",
       .label = "maximum L2 error / diagonal",
       .decimals = 5,
       .better = Better::kLower,
       .shown_in = {kSummaryTable, kVariantTable, kComparison, kTerminal, kIndexPage},
       .definition = "l2_max_m divided by diagonal_m, as paper A prints it in figure 11."},
      {.key = "l2_mean_visible_m",
       .label = "mean L2 error, visible surface",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kGate},
       .definition = "l2_mean_m over the vertices whose true place the camera sees."},
      {.key = "l2_max_visible_m",
       .label = "maximum L2 error, visible surface",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 1,
       .better = Better::kLower,
       .definition = "l2_max_m over the vertices whose true place the camera sees."},
      {.key = "l2_mean_hidden_m",
       .label = "mean L2 error, hidden surface",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kGate},
       .definition = "l2_mean_m over the vertices whose true place the camera does not see."},
      {.key = "l2_max_hidden_m",
       .label = "maximum L2 error, hidden surface",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 1,
       .better = Better::kLower,
       .definition = "l2_max_m over the vertices whose true place the camera does not see."},
      {.key = "l2_median_m",
       .label = "median L2 error",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition =
           "Per frame: the median over the vertices of the distance between corresponding points."},
      {.key = "l2_p95_m",
       .label = "L2 error, 95th percentile",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "Per frame: the 95th percentile over the vertices of the distance between "
                     "corresponding points."},
      {.key = "l2_p99_m",
       .label = "L2 error, 99th percentile",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "Per frame: the 99th percentile over the vertices of the distance between "
                     "corresponding points."},
      {.key = "diagonal_m",
       .label = "diagonal of the bounding box",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 1,
       .definition = "Length of the diagonal of the true subject's rest-pose bounding box."},
  };
}

// Distance to the nearest surface point.
std::vector<Metric> NearestPointErrors() {
  return {
      {.key = "surface_mean_m",
       .label = "mean surface error",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kVariantTable, kComparison, kTerminal, kIndexPage, kGate, kHistoryPlot},
       .definition = "Study of body shapes: the mean distance between the fitted and the true "
                     "surface, from the vertices of each to the nearest point of the other, both "
                     "in the T-pose and rigidly aligned. Study of skinning weights: the mean "
                     "distance of a skinned vertex from its example, over all poses."},
      {.key = "surface_p95_m",
       .label = "surface error, 95th percentile",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kGate},
       .definition = "The 95th percentile of the distances whose mean is surface_mean_m."},
      {.key = "surface_max_m",
       .label = "maximum surface error",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kVariantTable, kComparison, kTerminal, kIndexPage, kGate},
       .definition = "The maximum of the distances whose mean is surface_mean_m."},
      {.key = "surface_rmse_m",
       .label = "RMS surface error",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kGate},
       .definition =
           "Root mean square distance of a skinned vertex from its example, over all poses."},
      {.key = "surface_visible_mean_m",
       .label = "mean distance to the true surface, visible part",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "Mean distance of the estimate's visible vertices to the nearest point of the "
                     "true surface, over every n-th frame (setting reconstruction_every)."},
      {.key = "surface_visible_p95_m",
       .label = "distance to the true surface, visible part, 95th percentile",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "The 95th percentile of the distances whose mean is surface_visible_mean_m."},
      {.key = "reconstruction_mean_m",
       .label = "mean reconstruction error",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "Mean distance of the estimate's visible vertices to the nearest observed "
                     "point, over every n-th frame (setting reconstruction_every), as paper B "
                     "measures it for its figure 6."},
      {.key = "reconstruction_p95_m",
       .label = "reconstruction error, 95th percentile",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "The 95th percentile of the distances whose mean is reconstruction_mean_m."},
      {.key = "vertex_mean_m",
       .label = "mean vertex error",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kGate},
       .definition = "Mean distance between corresponding vertices of the fitted and the true "
                     "body, both in the T-pose and rigidly aligned."},
  };
}

// Joints.
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
           "truth is known. In a series per frame it is the mean over the joints of that frame."},
      {.key = "joint_error_mean_visible_m",
       .label = "mean joint error, visible joints",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "joint_error_mean_m over the joints that the camera sees."},
      {.key = "joint_error_mean_hidden_m",
       .label = "mean joint error, hidden joints",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "joint_error_mean_m over the joints that the camera does not see."},
      {.key = "joint_error_max_m",
       .label = "maximum joint error",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kGate},
       .definition = "Maximum distance between an estimated and a true joint. In a series per "
                     "frame it is the maximum over the joints of that frame."},
      {.key = "joint_error_mean_less_offset_m",
       .label = "mean joint error, less each joint's mean offset",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "joint_error_mean_m after the mean offset of each joint over the frames is "
                     "subtracted, for methods and recordings that define their joints "
                     "differently."},
      {.key = "joints_within_2cm",
       .label = "joints within 2 cm",
       .unit = "%",
       .scale = 1e2,
       .decimals = 2,
       .better = Better::kHigher,
       .definition = "Share of the joints, over all frames, whose estimate lies within 2 cm of the "
                     "truth."},
      {.key = "joints_within_5cm",
       .label = "joints within 5 cm",
       .unit = "%",
       .scale = 1e2,
       .decimals = 2,
       .better = Better::kHigher,
       .definition = "Share of the joints, over all frames, whose estimate lies within 5 cm of the "
                     "truth."},
      {.key = "joints_within_10cm",
       .label = "joints within 10 cm",
       .unit = "%",
       .scale = 1e2,
       .decimals = 2,
       .better = Better::kHigher,
       .shown_in = {kSummaryTable, kVariantTable, kComparison, kTerminal, kIndexPage, kGate},
       .definition = "Share of the joints, over all frames, whose estimate lies within 10 cm of "
                     "the truth (paper A, section 7.1)."},
      {.key = "joints_within_10cm_less_offset",
       .label = "joints within 10 cm, less each joint's mean offset",
       .unit = "%",
       .scale = 1e2,
       .decimals = 2,
       .better = Better::kHigher,
       .definition =
           "joints_within_10cm after the mean offset of each joint over the frames is subtracted, "
           "for recordings that define their joints differently (paper B on EVAL)."},
      {.key = "joint_auc_30cm",
       .label = "joint accuracy, area under the curve to 30 cm",
       .decimals = 4,
       .better = Better::kHigher,
       .definition =
           "Share of joints within a threshold, averaged over the thresholds from 0 to 30 cm."},
  };
}

// Whether a tracker knows its error.
std::vector<Metric> UncertaintyMetrics() {
  return {
      {.key = "covariances_given",
       .label = "visible joints with a covariance",
       .unit = "%",
       .scale = 1e2,
       .decimals = 1,
       .better = Better::kHigher,
       .definition = "Share of the visible joints, over all frames, for which the tracker gives a "
                     "covariance."},
      {.key = "coverage_68",
       .label = "coverage of the 68 % regions",
       .unit = "%",
       .scale = 1e2,
       .decimals = 1,
       .shown_in = {kVariantTable, kTerminal},
       .definition = "Share of the visible joints with a covariance that lie within the ellipsoid "
                     "that should hold 68 % of them."},
      {.key = "coverage_95",
       .label = "coverage of the 95 % regions",
       .unit = "%",
       .scale = 1e2,
       .decimals = 1,
       .shown_in = {kVariantTable, kTerminal},
       .definition = "Share of the visible joints with a covariance that lie within the ellipsoid "
                     "that should hold 95 % of them."},
      {.key = "negative_log_likelihood",
       .label = "negative log-likelihood of the joints",
       .unit = "nats",
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kVariantTable},
       .definition = "−log of the Gaussian density, in 1/m³, that the tracker gave to the true "
                     "place of a joint: the mean over the visible joints with a covariance."},
      {.key = "unreliable_told",
       .label = "joints off by more than 5 cm, told",
       .unit = "%",
       .scale = 1e2,
       .decimals = 1,
       .better = Better::kHigher,
       .shown_in = {kVariantTable},
       .definition = "Share of the visible joints off by more than 5 cm that the tracker called "
                     "unreliable."},
      {.key = "unreliable_false_alarms",
       .label = "joints within 5 cm, called unreliable",
       .unit = "%",
       .scale = 1e2,
       .decimals = 1,
       .better = Better::kLower,
       .shown_in = {kVariantTable},
       .definition = "Share of the visible joints within 5 cm that the tracker called unreliable."},
  };
}

// What a single frame allows.
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
           "may pass it."},
      {.key = "joint_error_rms_visible_m",
       .label = "joint error, visible joints, root mean square",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kVariantTable},
       .definition = "Root mean square of the joint error over the visible joints and the frames "
                     "of joint_bound_rms_visible_m."},
      {.key = "joint_efficiency",
       .label = "efficiency of the joints",
       .decimals = 3,
       .better = Better::kHigher,
       .shown_in = {kSummaryTable, kVariantTable, kTerminal},
       .definition = "joint_bound_rms_visible_m / joint_error_rms_visible_m: 1 is what a single "
                     "frame allows."},
  };
}

// How the limbs move.
std::vector<Metric> MotionErrors() {
  return {
      {.key = "twist_rms_deg",
       .label = "twist error, RMS",
       .unit = "°",
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kComparison, kGate, kPictureNote},
       .definition = "Root mean square over frames and limbs of the rotation of the estimate "
                     "against the truth about the limb's own axis."},
      {.key = "jitter_rms_rad_s2",
       .label = "jitter, RMS",
       .unit = "rad/s²",
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kComparison, kGate, kPictureNote},
       .definition = "Root mean square over bones and frames of the difference between the "
                     "estimated and the true angular acceleration."},
  };
}

// Fitted bodies and scans.
std::vector<Metric> BodyErrors() {
  return {
      {.key = "height_error_m",
       .label = "height error",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kComparison, kTerminal, kGate},
       .definition = "Absolute difference between the fitted and the true body height."},
      {.key = "weight_error_kg",
       .label = "weight error",
       .unit = "kg",
       .decimals = 4,
       .better = Better::kLower,
       .shown_in = {kComparison, kTerminal, kGate},
       .definition = "Absolute difference between the fitted and the true body weight."},
      {.key = "scan_to_truth_mean_m",
       .label = "mean distance from scan to truth",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kGate},
       .definition =
           "Mean distance of the scan's vertices to the nearest point of the true surface."},
      {.key = "scan_to_truth_max_m",
       .label = "maximum distance from scan to truth",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition =
           "Maximum distance of the scan's vertices to the nearest point of the true surface."},
      {.key = "camera_error_max_m",
       .label = "maximum camera error",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kGate},
       .definition = "Maximum distance over the scan's frames between the estimated and the true "
                     "camera centre."},
      {.key = "poses", .label = "poses", .definition = "Number of example poses."},
  };
}

// Time, effort and memory.
std::vector<Metric> Costs() {
  return {
      {.key = "frame_ms",
       .label = "time per frame",
       .unit = "ms",
       .decimals = 1,
       .better = Better::kLower,
       .definition = "Per frame: wall-clock time of the tracker's step, without reading, writing "
                     "or scoring."},
      {.key = "frame_ms_median",
       .label = "time per frame, median",
       .unit = "ms",
       .decimals = 1,
       .better = Better::kLower,
       .shown_in = {kSummaryTable, kVariantTable, kComparison, kTerminal, kIndexPage},
       .definition = "Median over the frames of frame_ms."},
      {.key = "frame_ms_p95",
       .label = "time per frame, 95th percentile",
       .unit = "ms",
       .decimals = 1,
       .better = Better::kLower,
       .shown_in = {kSummaryTable, kComparison, kIndexPage},
       .definition = "95th percentile over the frames of frame_ms."},
      {.key = "frame_ms_max",
       .label = "time per frame, maximum",
       .unit = "ms",
       .decimals = 1,
       .better = Better::kLower,
       .definition = "Maximum over the frames of frame_ms."},
      {.key = kCalibratedTime,
       .label = "time per frame, median / calibration kernel",
       .decimals = 3,
       .better = Better::kLower,
       .shown_in = {kComparison},
       .definition = "frame_ms_median as a multiple of the time of the calibration kernel in the "
                     "same process. It compares across machines."},
      {.key = "iterations_mean",
       .label = "iterations per frame, mean",
       .decimals = 2,
       .shown_in = {kSummaryTable},
       .definition = "Mean number of iterations that the method took for a frame."},
      {.key = "iterations",
       .label = "iterations",
       .definition = "Number of iterations of a frame, or of the fit of a body."},
      {.key = "tracker_memory_mb",
       .label = "the tracker's memory, at most",
       .unit = "MB",
       .better = Better::kLower,
       .definition = "Largest resident memory of the tracker's process."},
      {.key = "fit_ms",
       .label = "time of the fit",
       .unit = "ms",
       .decimals = 2,
       .better = Better::kLower,
       .definition = "Wall-clock time of fitting a body to a scan."},
      {.key = "scan_s",
       .label = "time of the scan",
       .unit = "s",
       .decimals = 2,
       .better = Better::kLower,
       .definition = "Wall-clock time of fusing the frames of a scan and extracting its surface."},
  };
}

// What the solver reports.
std::vector<Metric> SolverDiagnostics() {
  return {
      {.key = "condition",
       .label = "condition number",
       .definition = "Per frame: estimated condition number of the normal equations; -1 where it "
                     "was not estimated."},
      {.key = "condition_max",
       .label = "condition number, maximum",
       .definition = "Maximum over the frames of condition."},
      {.key = "weak_directions",
       .label = "weak directions of the normal equations",
       .better = Better::kLower,
       .definition = "Per frame: eigenvalues of the last normal equations below 1e-6 of the "
                     "largest; only where energies are watched."},
      {.key = "weak_directions_max",
       .label = "weak directions of the normal equations, maximum",
       .better = Better::kLower,
       .definition = "Maximum over the frames of weak_directions."},
      {.key = "agreeing_digits",
       .label = "digits of the solution",
       .decimals = 1,
       .better = Better::kHigher,
       .definition = "Per frame: −log10 of the relative difference between the last step and that "
                     "of a slow solution of the same equations in double precision; only where "
                     "energies are watched."},
      {.key = "agreeing_digits_min",
       .label = "digits of the solution, minimum",
       .decimals = 1,
       .better = Better::kHigher,
       .definition = "Minimum over the frames of agreeing_digits."},
      {.key = "rotation_drift",
       .label = "rotation drift",
       .decimals = 4,
       .better = Better::kLower,
       .definition = "Per frame: the largest ‖RᵀR − I‖ of any bone's rotation R."},
      {.key = "rotation_drift_max",
       .label = "rotation drift, maximum",
       .decimals = 4,
       .better = Better::kLower,
       .definition = "Maximum over the frames of rotation_drift."},
      {.key = "energy_mean",
       .label = "energy, mean",
       .decimals = 4,
       .definition = "Sum of all energy terms, averaged over the frames. Only runs of one method "
                     "with the same weights compare."},
      {.key = "energy_rise",
       .label = "rise of the energy",
       .decimals = 4,
       .better = Better::kLower,
       .definition = "Per frame: the largest rise of the energy in any step, as a share; -1 where "
                     "steps were not watched."},
      {.key = "energy_rises",
       .label = "frames whose energy rose",
       .better = Better::kLower,
       .definition = "Number of frames with a step that raised the energy."},
      {.key = "energy_rise_max",
       .label = "rise of the energy, maximum",
       .decimals = 4,
       .better = Better::kLower,
       .definition = "Maximum over the frames of energy_rise."},
  };
}

// What the camera saw against the estimate: no truth is needed.
std::vector<Metric> ObservationErrors() {
  return {
      {.key = "fit_m",
       .label = "misfit to the observation",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kSummaryTable, kVariantTable, kTerminal},
       .definition = "The mean of fit_points_mean_m and fit_model_mean_m, per frame; in a summary "
                     "row the mean over the frames in which the person is measured."},
      {.key = "fit_points_mean_m",
       .label = "observed points to model, mean",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "Distance of each observed point of the person to the nearest place of the "
                     "estimated surface: the mean, per frame and over all frames."},
      {.key = "fit_points_median_m",
       .label = "observed points to model, median",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "The median of the distances whose mean is fit_points_mean_m."},
      {.key = "fit_points_p95_m",
       .label = "observed points to model, 95th percentile",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "The 95th percentile of the distances whose mean is fit_points_mean_m."},
      {.key = "fit_model_mean_m",
       .label = "visible model to observed points, mean",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "Distance of each vertex of the estimate that would be visible to the nearest "
                     "observed point of the person: the mean, per frame and over all frames."},
      {.key = "fit_model_median_m",
       .label = "visible model to observed points, median",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "The median of the distances whose mean is fit_model_mean_m."},
      {.key = "fit_model_p95_m",
       .label = "visible model to observed points, 95th percentile",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "The 95th percentile of the distances whose mean is fit_model_mean_m."},
      {.key = "silhouette_overlap",
       .label = "overlap of silhouettes",
       .unit = "%",
       .scale = 1e2,
       .decimals = 1,
       .better = Better::kHigher,
       .shown_in = {kSummaryTable, kTerminal},
       .definition = "Pixels that the rendered estimate and the measured person share, divided by "
                     "the pixels that either has; holes of the measurement count against it."},
      {.key = "points_unexplained",
       .label = "unexplained points",
       .unit = "%",
       .scale = 1e2,
       .decimals = 1,
       .better = Better::kLower,
       .shown_in = {kSummaryTable, kTerminal},
       .definition = "Share of the observed points of the person that lie farther than 5 cm from "
                     "the estimated surface."},
      {.key = "model_in_front",
       .label = "model in front of the data",
       .unit = "%",
       .scale = 1e2,
       .decimals = 1,
       .better = Better::kLower,
       .shown_in = {kSummaryTable, kTerminal},
       .definition =
           "Share of the pixels of the rendered estimate with a measurement, of the person or of "
           "the room, more than 5 cm behind it: the camera looked through where the estimate is."},
      {.key = "limb_length_change",
       .label = "change of limb lengths",
       .unit = "%",
       .scale = 1e2,
       .decimals = 1,
       .better = Better::kLower,
       .definition = "Largest deviation of a limb (upper arm, forearm, thigh, shin) from its "
                     "median length over the run, divided by that length; a person has none."},
      {.key = "limb_asymmetry",
       .label = "difference between left and right limbs",
       .unit = "%",
       .scale = 1e2,
       .decimals = 1,
       .better = Better::kLower,
       .definition = "Largest difference between the median lengths of a left and the right limb, "
                     "divided by their mean."},
      {.key = "view_mean_m",
       .label = "second view to model, mean",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kSummaryTable, kTerminal},
       .definition = "Distance of the points that a second calibrated camera saw, and the first "
                     "one could not see, to the nearest place of the estimated surface: the mean, "
                     "per frame and over all frames."},
      {.key = "view_median_m",
       .label = "second view to model, median",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "The median of the distances whose mean is view_mean_m."},
      {.key = "view_p95_m",
       .label = "second view to model, 95th percentile",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "The 95th percentile of the distances whose mean is view_mean_m."},
      {.key = "fit_rank_correlation",
       .label = "rank correlation of misfit and visible error",
       .decimals = 2,
       .better = Better::kHigher,
       .definition =
           "Spearman correlation over the frames of a run between fit_m and the true error of the "
           "visible surface, l2_mean_visible_m or two_way_visible_mean_m: how well the misfit "
           "orders frames by what the camera could show."},
      {.key = "fit_rank_correlation_whole",
       .label = "rank correlation of misfit and whole error",
       .decimals = 2,
       .better = Better::kHigher,
       .definition = "As fit_rank_correlation, with the error of the whole surface, l2_mean_m or "
                     "two_way_mean_m; nothing observed tells where hidden parts are."},
  };
}

// Distance in both directions to a true surface that has its own triangles in each frame.
std::vector<Metric> OwnSurfaceErrors() {
  return {
      {.key = "two_way_mean_m",
       .label = "two-way distance to the true surface, mean",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kSummaryTable, kVariantTable, kComparison, kTerminal},
       .definition = "Distance from the vertices of the estimate to the true surface of the frame, "
                     "and from the vertices of the true surface to the estimate, without "
                     "correspondence: the mean of the two means, per frame and over all frames."},
      {.key = "two_way_p95_m",
       .label = "two-way distance to the true surface, 95th percentile",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition =
           "The 95th percentile of the distances of both directions that two_way_mean_m averages."},
      {.key = "two_way_visible_mean_m",
       .label = "two-way distance to the true surface, mean of the visible part",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .shown_in = {kSummaryTable, kVariantTable, kComparison, kTerminal},
       .definition =
           "As two_way_mean_m, over the vertices of each surface that the camera would see of it."},
      {.key = "two_way_visible_p95_m",
       .label = "two-way distance to the true surface, 95th percentile of the visible part",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "The 95th percentile of the distances of both directions that "
                     "two_way_visible_mean_m averages."},
      {.key = "to_truth_mean_m",
       .label = "estimate to true surface, mean",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "Distance from the vertices of the estimate to the nearest place of the true "
                     "surface of the frame."},
      {.key = "from_truth_mean_m",
       .label = "true surface to estimate, mean",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "Distance from the vertices of the true surface of the frame to the nearest "
                     "place of the estimate."},
  };
}

}  // namespace

const std::vector<Metric>& MetricCatalogue() {
  static const std::vector<Metric> catalogue = [] {
    std::vector<Metric> all;
    for (const auto& entries :
         {IdentityColumns(), FrameCounts(), CorrespondingPointErrors(), NearestPointErrors(),
          OwnSurfaceErrors(), ObservationErrors(), JointErrorMetrics(), BoundMetrics(),
          UncertaintyMetrics(), MotionErrors(), BodyErrors(), Costs(), SolverDiagnostics()})
      all.insert(all.end(), entries.begin(), entries.end());
    return all;
  }();
  return catalogue;
}

const std::vector<Metric>& MetricFamilies() {
  static const std::vector<Metric> families = {
      {.key = kJointErrorOfJoint,
       .label = "mean error of joint {joint}",
       .unit = "mm",
       .scale = 1e3,
       .decimals = 2,
       .better = Better::kLower,
       .definition = "joint_error_mean_m of one joint."},
      {.key = kStepMedian,
       .label = "time of step {step} per frame, median",
       .unit = "ms",
       .decimals = 2,
       .better = Better::kLower,
       .definition = "Median over the frames of the time of one step of the method, summed over "
                     "the frame's iterations."},
      {.key = kStepP95,
       .label = "time of step {step} per frame, 95th percentile",
       .unit = "ms",
       .decimals = 2,
       .better = Better::kLower,
       .definition = "95th percentile over the frames of the time of one step of the method, "
                     "summed over the frame's iterations."},
      {.key = kStepMax,
       .label = "time of step {step} per frame, maximum",
       .unit = "ms",
       .decimals = 2,
       .better = Better::kLower,
       .definition = "Maximum over the frames of the time of one step of the method, summed over "
                     "the frame's iterations."},
      {.key = kOwnSummary,
       .label = "{name}",
       .decimals = 4,
       .definition = "A summary that the experiment defines: a statistic over the frames that have "
                     "a value of the series (vitruvia explain experiment.summaries), failed and "
                     "lost frames included, in the unit of the stored series."},
      {.key = kEnergyOfTerm,
       .label = "energy of term {term}",
       .decimals = 4,
       .definition = "Per frame: the value of one energy term at the end of the frame."},
  };
  return families;
}

}  // namespace vitruvia
