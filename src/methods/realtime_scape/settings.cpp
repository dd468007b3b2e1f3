#include "methods/realtime_scape/settings.h"

namespace vitruvia::realtime_scape {

void CloudSettings::Describe(Fields& f) {
  f.Integer(
      "stride", stride,
      {.meaning = "stride in columns and rows of the pixels that become points of the cloud P",
       .unit = "px",
       .min = 1,
       .max = 16,
       .origin = Origin::kPaper,
       .source = "paper A, sec. 6.2: half resolution"});
  DescribeMaxDepth(f, max_depth_m);
  f.Integer(
      "least_neighbors", least_neighbors,
      {.meaning =
           "a pixel is a measurement only if at least this many of the eight pixels "
           "round it hold a similar depth; others are flying pixels, which "
           "time-of-flight cameras measure at edges between two surfaces (3 for a Kinect One); "
           "0: all are",
       .min = 0,
       .max = 8,
       .origin = Origin::kPaper,
       .source = "paper A: 0"});
  if (!f.Applies(least_neighbors > 0)) return;
  f.Number("neighbor_within_m", neighbor_within_m,
           {.meaning = "largest difference of two similar depths",
            .unit = "m",
            .min = 1e-4,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = "as fit.near_surface_m"});
}

void MotionSettings::Describe(Fields& f) {
  f.Choice("model", model,
           {{"constant_rotation", MotionModel::kConstantRotation},
            {"constant_velocity", MotionModel::kConstantVelocity}},
           {.meaning = "motion model that predicts the initial pose of a frame and the reference "
                       "rotations of the inertia term",
            .origin = Origin::kTuned,
            .source = "paper A: constant_rotation"});
  if (!f.Applies(model == MotionModel::kConstantVelocity)) return;
  f.Number(
      "velocity_share", velocity_share,
      {.meaning =
           "share of the last frame's velocity that the motion model predicts for the next frame",
       .min = 0,
       .max = 1,
       .origin = Origin::kTuned,
       .source = "realtime_scape/fig11 and cmu/walk: 1 needs fewer iterations, 0.8 errs less"});
  f.Number(
      "hidden_decay", hidden_decay,
      {.meaning = "factor by which a bone's predicted velocity decays per frame while the bone is "
                  "unobserved",
       .min = 0,
       .max = 1,
       .origin = Origin::kGuessed,
       .source = "an unobserved limb comes to rest within half a second"});
}

void StoppingSettings::Describe(Fields& f) {
  f.Number(
      "rotation_step_deg", rotation_step_deg,
      {.meaning = "iterations stop when every bone has rotated by less than this and moved by less "
                  "than translation_step_m",
       .unit = "deg",
       .min = 1e-6,
       .max = 180,
       .origin = Origin::kTuned,
       .source =
           "paper A, sec. 6.2: ε₁ = 5, which often stops after one iteration; with ε₂ = 0.025 "
           "2.1 mm mean error on realtime_scape/fig11, so 1.4"});
  f.Number("translation_step_m", translation_step_m,
           {.meaning =
                "iterations stop when the centre of every bone has moved by less than this and no "
                "bone has rotated by rotation_step_deg",
            .unit = "m",
            .min = 1e-9,
            .max = 10,
            .origin = Origin::kTuned,
            .source = "paper A, sec. 6.2: ε₂ = 0.025; see rotation_step_deg"});
  f.Number(
      "energy_decrease", energy_decrease,
      {.meaning = "iterations stop when the predicted decrease of the linearised energy is less "
                  "than this share of the energy, which is below the effect of noise; 0: never",
       .min = 0,
       .max = 1,
       .origin = Origin::kTuned,
       .source =
           "ablations/stopping: half of the time under noise, errors as with 0; 0.05 and more "
           "lose a captured walk"});
  f.Integer("max_iterations", max_iterations,
            {.meaning = "maximum number of iterations for a frame",
             .min = 1,
             .max = 1000,
             .origin = Origin::kPaper,
             .source = "paper A, sec. 6.2: n_max"});
  f.Integer(
      "first_frame_iterations", first_frame_iterations,
      {.meaning = "maximum number of iterations for the first frame, which starts from the rest "
                  "pose, and for each pose that relocalisation refines",
       .min = 1,
       .max = 1000,
       .origin = Origin::kGuessed,
       .source = "paper A is silent"});
}

void SolverSettings::Describe(Fields& f) {
  f.Choice("kind", linear.kind,
           {{"cg", LinearSolverKind::kConjugateGradients},
            {"pcg", LinearSolverKind::kPreconditionedConjugateGradients},
            {"cholesky", LinearSolverKind::kDenseCholesky},
            {"sparse_cholesky", LinearSolverKind::kSparseCholesky}},
           {.meaning = "linear solver of the normal equations",
            .origin = Origin::kTuned,
            .source = "paper A: conjugate gradients, preconditioner not said"});
  const bool iterative = linear.kind == LinearSolverKind::kConjugateGradients ||
                         linear.kind == LinearSolverKind::kPreconditionedConjugateGradients;
  if (f.Applies(iterative)) {
    f.Number("relative_tolerance", linear.relative_tolerance,
             {.meaning =
                  "conjugate gradients stop when the norm of the residual has fallen to this share "
                  "of its initial value",
              .min = 1e-15,
              .max = 0.5,
              .origin = Origin::kGuessed,
              .source = "paper A is silent"});
    f.Integer("max_iterations", linear.max_iterations,
              {.meaning = "maximum number of iterations of conjugate gradients",
               .min = 1,
               .max = 10000,
               .origin = Origin::kGuessed,
               .source = "twice the 102 unknowns"});
  }
  if (f.Applies(!iterative)) {
    f.Choice("precision", linear.precision,
             {{"double", Precision::kDouble}, {"float", Precision::kFloat}},
             {.meaning = "floating point precision of the Cholesky factors",
              .origin = Origin::kGuessed,
              .source = "paper A is silent"});
  }
  f.Number(
      "damping", damping,
      {.meaning =
           "value added to the diagonal of the normal equations (energy per rad² or length unit²)",
       .min = 0,
       .max = 1e9,
       .origin = Origin::kGuessed,
       .source = "keeps the system regular when nothing at all is seen"});
  f.Flag("watch_energy", watch_energy,
         {.meaning = "evaluates the energy a second time after each step, with the same "
                     "correspondences, and reports the largest rise; compares each frame's last "
                     "step with a reference solution of the same equations"});
}

void Settings::Describe(Fields& f) {
  f.Section("cloud", cloud, {.meaning = "the observed points P"});
  f.Section("fit", fit,
            {.meaning = "term 1 of the energy, goodness of fit, and its correspondences"});
  f.Section("search", search, {.meaning = "assignment of unexplained points to bones"});
  f.Section("motion", motion, {.meaning = "prediction of the next frame"});
  DescribeEnergy(f);
  f.Choice(
      "rotation_update", rotation_update,
      {{"linear", RotationUpdate::kLinear},
       {"linear_orthonormal", RotationUpdate::kLinearOrthonormal},
       {"exponential", RotationUpdate::kExponential}},
      {.meaning = "update of a rotation by the solved increment r: R ← (I + r̂) R, the rotation "
                  "nearest to that, or R ← exp(r̂) R",
       .origin = Origin::kTuned,
       .source = "paper A, sec. 6.2: linear, which leaves the set of rotations"});
  f.Section("stopping", stopping, {.meaning = "stopping rule of the iterations"});
  f.Section("solver", solver, {.meaning = "solver of the linearised problem"});
  DescribeStart(f, start);
  f.Section("placement", placement, {.meaning = "first placement of the rest pose"});
  if (f.Applies(start == Start::kSearch)) {
    f.Section("start_search", start_search, {.meaning = "search for the first pose"});
  }
  f.Section("limbs", limbs, {.meaning = "search for limbs that moved away from the model"});
  f.Section("facing", facing, {.meaning = "search for a body that is tracked back to front"});
  f.Section("recovery", recovery, {.meaning = "detection of a lost subject and relocalisation"});
  f.Section(
      "watch", watch,
      {.meaning = "detection of a lost subject by the areas in which model and frame disagree"});
  f.Section("uncertainty", uncertainty,
            {.meaning = "covariances of the joints, from the normal equations"});
  DescribeLostBelow(f, lost_below);
  DescribeLeastPoints(f, least_points);
}

void Settings::DescribeEnergy(Fields& f) {
  f.Choice(
      "joint_rows", joint_rows,
      {{"joint_position", JointRows::kJointPosition},
       {"mean_point", JointRows::kMeanPoint},
       {"all_vertices", JointRows::kAllVertices}},
      {.meaning =
           "what connects two bones: the skeleton's joint or the mean of their shared vertices, "
           "about both of which they rotate freely, or every shared vertex, which resists bending "
           "and twisting",
       .origin = Origin::kTuned,
       .source =
           "paper A, sec. 6.2 counts 3 rows a joint, eq. 7 prints all vertices; mean errors on "
           "realtime_scape/fig11: 1.4, 2.2 and 6 mm"});
  f.Visit(weights);
  if (f.Applies(weights[EnergyTerm::kLimit] > 0.0)) {
    f.Number(
        "limit_slack_deg", limit_slack_deg,
        {.meaning = "angle by which a joint may exceed its anatomical range at no cost",
         .unit = "deg",
         .min = 0,
         .max = 180,
         .origin = Origin::kGuessed,
         .source = "captured skeletons exceed the ranges by some degrees, for their joints are "
                   "not quite a body's"});
  }
  f.Number(
      "length_unit_m", length_unit_m,
      {.meaning = "length that counts as 1 where squared lengths are added to squared entries of "
                  "rotation matrices",
       .unit = "m",
       .min = 1e-4,
       .max = 10,
       .origin = Origin::kTuned,
       .source =
           "paper A is silent. On realtime_scape/fig11 0.03 … 0.08 all meet the paper's figures; "
           "at 1 the inertia lags (16 mm mean error), at 0.01 limbs twist (171 mm maximum)"});
}

}  // namespace vitruvia::realtime_scape
