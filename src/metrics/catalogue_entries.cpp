#include "metrics/catalogue_entries.h"

namespace vitruvia {

const std::vector<MetricGroup>& MetricGroups() {
  static const std::vector<MetricGroup> groups = {
      {"The run", IdentityColumns()},
      {"Frames", FrameCounts()},
      {"Distance of corresponding surface points", CorrespondingPointErrors()},
      {"Distance to the nearest surface point", NearestPointErrors()},
      {"Distance to a true surface with triangles of its own", OwnSurfaceErrors()},
      {"The estimate against what the camera saw", ObservationErrors()},
      {"Joints", JointErrorMetrics()},
      {"What a single frame allows", BoundMetrics()},
      {"Whether the tracker knows its error", UncertaintyMetrics()},
      {"Motion", MotionErrors()},
      {"Bodies and scans", BodyErrors()},
      {"Time, effort and memory", Costs()},
      {"The solver", SolverDiagnostics()}};
  return groups;
}

const std::vector<Metric>& MetricCatalogue() {
  static const std::vector<Metric> catalogue = [] {
    std::vector<Metric> all;
    for (const MetricGroup& group : MetricGroups())
      all.insert(all.end(), group.metrics.begin(), group.metrics.end());
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
       .definition = "joint_error_mean_m of one joint.",
       .formula = "mean_f ‖ĵ_fj − j_fj‖",
       .averaged_over = "the frames whose truth is known",
       .hidden_and_lost = kJointsCount},
      {.key = kStepMedian,
       .label = "time of step {step} per frame, median",
       .unit = "ms",
       .decimals = 2,
       .better = Better::kLower,
       .definition = "Median over the frames of the time of one step of the method, summed over "
                     "the frame's iterations.",
       .formula = "median_f t_f,step",
       .averaged_over = kOverStepFrames,
       .hidden_and_lost = kFramesCount},
      {.key = kStepP95,
       .label = "time of step {step} per frame, 95th percentile",
       .unit = "ms",
       .decimals = 2,
       .better = Better::kLower,
       .definition = "95th percentile over the frames of the time of one step of the method, "
                     "summed over the frame's iterations.",
       .formula = "p95_f t_f,step",
       .averaged_over = kOverStepFrames,
       .hidden_and_lost = kFramesCount},
      {.key = kStepMax,
       .label = "time of step {step} per frame, maximum",
       .unit = "ms",
       .decimals = 2,
       .better = Better::kLower,
       .definition = "Maximum over the frames of the time of one step of the method, summed over "
                     "the frame's iterations.",
       .formula = "max_f t_f,step",
       .hidden_and_lost = kFramesCount},
      {.key = kOwnSummary,
       .label = "{name}",
       .decimals = 4,
       .definition = "A summary that the experiment defines: a statistic over the frames that have "
                     "a value of the series (vitruvia explain experiment.summaries), failed and "
                     "lost frames included, in the unit of the stored series.",
       .formula = "statistic_f series_f",
       .averaged_over = "the frames that have a value",
       .hidden_and_lost = kFramesCount},
      {.key = kEnergyOfTerm,
       .label = "energy of term {term}",
       .decimals = 4,
       .definition = "Per frame: the value of one energy term at the last linearisation, weighted "
                     "as it is minimised.",
       .formula = "E_term at the last linearisation",
       .hidden_and_lost = kWhereReported},
  };
  return families;
}

const std::vector<std::string>& FormulaSymbols() {
  static const std::vector<std::string> symbols = {
      "f: a frame; v: a vertex; j: a joint; b: a bone; p: an observed point of the person.",
      "mean, median, p95, p99, max and Σ stand before what they are taken of; their index says "
      "over what, and [ … ] is 1 where the condition holds and 0 elsewhere.",
      "x̂, ĵ, R̂, Ŝ: vertex, joint, rotation and surface of the estimate; x, j, R, S: the true ones. "
      "Of the L2 errors x_fv is the point of the true surface that belongs to the estimate's "
      "vertex v: the nearest one in the rest pose.",
      "d(a, B): distance of the point a to the nearest place of B. P_f: the observed points.",
      "V_f: the vertices whose true place the camera sees, no more than 1 cm behind the rendered "
      "true surface; V̂_f: the same of the estimate's own surface.",
      "An error that is not finite counts as infinite, so that a mean cannot hide it."};
  return symbols;
}

}  // namespace vitruvia
