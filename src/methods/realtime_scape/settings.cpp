#include "methods/realtime_scape/settings.h"

namespace vitruvia::realtime_scape {

void CloudSettings::Describe(Fields& f) {
  f.Integer("stride", stride,
            {.meaning = "every how many columns and rows a pixel joins the cloud P",
             .unit = "px",
             .min = 1,
             .max = 16,
             .origin = Origin::kPaper,
             .source = "paper A, sec. 6.2: half resolution"});
  f.Number("max_depth_m", max_depth_m,
           {.meaning = "pixels beyond are no measurement of the subject",
            .unit = "m",
            .min = 0.1,
            .max = 100,
            .origin = Origin::kGuessed,
            .source = "range of the depth cameras in use"});
}

void MotionSettings::Describe(Fields& f) {
  f.Choice("model", model,
           {{"constant_rotation", MotionModel::kConstantRotation},
            {"constant_velocity", MotionModel::kConstantVelocity}},
           {.meaning = "where a frame starts and what inertia holds on to",
            .origin = Origin::kTuned,
            .source = "paper A: constant_rotation"});
  if (!f.Applies(model == MotionModel::kConstantVelocity)) return;
  f.Number(
      "velocity_share", velocity_share,
      {.meaning = "share of the last step that is expected again",
       .min = 0,
       .max = 1,
       .origin = Origin::kTuned,
       .source = "realtime_scape/fig11 and cmu/walk: 1 needs fewer iterations, 0.8 errs less"});
  f.Number("hidden_decay", hidden_decay,
           {.meaning = "what is left of it with each frame in which the bone was not seen",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = "a limb out of sight comes to rest within half a second"});
}

void StoppingSettings::Describe(Fields& f) {
  f.Number("rotation_step_deg", rotation_step_deg,
           {.meaning = "stop when every bone turned by less in an iteration",
            .unit = "deg",
            .min = 1e-6,
            .max = 180,
            .origin = Origin::kTuned,
            .source =
                "paper A, sec. 6.2: ε₁ = 5, which often stops after one iteration; with ε₂ = 0.025 "
                "2.1 mm mean error on realtime_scape/fig11, so 1.4"});
  f.Number("translation_step_m", translation_step_m,
           {.meaning = "and every bone's centre moved by less",
            .unit = "m",
            .min = 1e-9,
            .max = 10,
            .origin = Origin::kTuned,
            .source = "paper A, sec. 6.2: ε₂ = 0.025; as above"});
  f.Integer("max_iterations", max_iterations,
            {.meaning = "at most this many iterations for a frame",
             .min = 1,
             .max = 1000,
             .origin = Origin::kPaper,
             .source = "paper A, sec. 6.2: n_max"});
  f.Integer("first_frame_iterations", first_frame_iterations,
            {.meaning = "at most this many in the first frame, which starts from the rest pose",
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
           {.meaning = "how the normal equations are solved",
            .origin = Origin::kTuned,
            .source = "paper A: conjugate gradients, preconditioner not said"});
  const bool iterative = linear.kind == LinearSolverKind::kConjugateGradients ||
                         linear.kind == LinearSolverKind::kPreconditionedConjugateGradients;
  if (f.Applies(iterative)) {
    f.Number("relative_tolerance", linear.relative_tolerance,
             {.meaning = "conjugate gradients stop when the residual has fallen by this factor",
              .min = 1e-15,
              .max = 0.5,
              .origin = Origin::kGuessed,
              .source = "paper A is silent"});
    f.Integer("max_iterations", linear.max_iterations,
              {.meaning = "conjugate gradient iterations at most",
               .min = 1,
               .max = 10000,
               .origin = Origin::kGuessed,
               .source = "twice the 102 unknowns"});
  }
  if (f.Applies(!iterative)) {
    f.Choice("precision", linear.precision,
             {{"double", Precision::kDouble}, {"float", Precision::kFloat}},
             {.meaning = "of Cholesky's factors",
              .origin = Origin::kGuessed,
              .source = "paper A is silent"});
  }
  f.Number(
      "damping", damping,
      {.meaning = "added to the diagonal of the normal equations (energy per rad² or length unit²)",
       .min = 0,
       .max = 1e9,
       .origin = Origin::kGuessed,
       .source = "keeps the system regular when nothing at all is seen"});
  f.Flag("watch_energy", watch_energy,
         {.meaning = "evaluates the energy once more after each step, on the same correspondences, "
                     "so that results can say by how much it ever rose"});
}

void PlacementSettings::Describe(Fields& f) {
  f.Integer(
      "iterations", iterations,
      {.meaning = "rigid closest-point iterations that put the rest pose onto the first frame",
       .min = 0,
       .max = 1000,
       .origin = Origin::kGuessed,
       .source = "paper A: the subject starts in a predetermined T-pose"});
  f.Number("trim", trim,
           {.meaning = "share of the worst pairs left out of each rigid fit",
            .min = 0,
            .max = 0.9,
            .origin = Origin::kGuessed,
            .source = "the arms may hang a little from the T-pose"});
  f.Numbers(
      "wrong_by_m", wrong_by_m,
      {.meaning = "the pose that they start from is moved by this, camera frame: to see what a "
                  "wrong start does",
       .unit = "m",
       .min = -10,
       .max = 10});
  f.Number("wrong_by_deg", wrong_by_deg,
           {.meaning = "and turned by this about its own vertical",
            .unit = "deg",
            .min = -180,
            .max = 180});
}

void RecoverySettings::Describe(Fields& f) {
  constexpr const char* kSource = "paper A lists recovery as future work";
  f.Integer("patience", patience,
            {.meaning = "frames in a row that must agree badly before other poses are tried; 0: "
                        "none ever is",
             .unit = "frames",
             .min = 0,
             .max = 1e6,
             .origin = Origin::kGuessed,
             .source = kSource});
  f.Integer("pause", pause,
            {.meaning = "frames between two attempts",
             .unit = "frames",
             .min = 1,
             .max = 1e6,
             .origin = Origin::kGuessed,
             .source = kSource});
  f.Number("below", below,
           {.meaning = "share of its usual level below which the agreement of model and frame is "
                       "bad",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = kSource});
  f.Number("margin", margin,
           {.meaning = "by how much the explained share of the cloud times the confirmed share of "
                       "the model must rise for another pose to be taken",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = kSource});
  f.Integer("remembered", remembered,
            {.meaning = "good poses that are kept to be tried",
             .min = 1,
             .max = 100,
             .origin = Origin::kGuessed,
             .source = kSource});
  f.Number("apart_deg", apart_deg,
           {.meaning = "mean turn of the joints by which kept poses differ",
            .unit = "deg",
            .min = 0,
            .max = 180,
            .origin = Origin::kGuessed,
            .source = kSource});
  f.Integer("tried", tried,
            {.meaning = "the best of all poses that get iterations",
             .min = 1,
             .max = 1000,
             .origin = Origin::kGuessed,
             .source = kSource});
}

void Settings::Describe(Fields& f) {
  f.Section("cloud", cloud, {.meaning = "the observed points P"});
  f.Section("fit", fit, {.meaning = "term 1, goodness of fit"});
  f.Section("search", search, {.meaning = "whose the unexplained points are"});
  f.Section("motion", motion, {.meaning = "what is expected of the next frame"});
  DescribeEnergy(f);
  f.Choice("rotation_update", rotation_update,
           {{"linear", RotationUpdate::kLinear},
            {"linear_orthonormal", RotationUpdate::kLinearOrthonormal},
            {"exponential", RotationUpdate::kExponential}},
           {.meaning = "how a rotation takes its step: R ← (I + r̂) R, the rotation nearest to "
                       "that, or R ← exp(r̂) R",
            .origin = Origin::kTuned,
            .source = "paper A, sec. 6.2: linear, which drifts away from the rotations"});
  f.Section("stopping", stopping, {.meaning = "when a frame is done"});
  f.Section("solver", solver, {.meaning = "the linear solver"});
  f.Section("placement", placement, {.meaning = "how the rest pose is put onto the first frame"});
  f.Section("recovery", recovery, {.meaning = "what is done when the subject is lost"});
  f.Number(
      "lost_below", lost_below,
      {.meaning =
           "a frame is lost when it confirms less than this share of the model's visible vertices "
           "on which it has a say",
       .min = 0,
       .max = 1,
       .origin = Origin::kGuessed,
       .source = "paper A is silent"});
}

void Settings::DescribeEnergy(Fields& f) {
  f.Choice(
      "joint_rows", joint_rows,
      {{"joint_position", JointRows::kJointPosition},
       {"mean_point", JointRows::kMeanPoint},
       {"all_vertices", JointRows::kAllVertices}},
      {.meaning =
           "what holds two bones together: the skeleton's joint or the mean of the vertices they "
           "share, both free to turn, or every such vertex, which resists bending and twisting",
       .origin = Origin::kTuned,
       .source =
           "paper A, sec. 6.2 counts 3 rows a joint, eq. 7 prints all vertices; mean errors on "
           "realtime_scape/fig11: 1.4, 2.2 and 6 mm"});
  f.Number("joint_weight", joint_weight,
           {.meaning = "α₁, keeps neighbouring bones connected",
            .min = 0,
            .max = 1e9,
            .origin = Origin::kPaper,
            .source = "paper A, eq. 7"});
  f.Number("inertia_weight", inertia_weight,
           {.meaning = "α₂, keeps each bone's local rotation as it was",
            .min = 0,
            .max = 1e9,
            .origin = Origin::kPaper,
            .source = "paper A, eq. 7"});
  f.Number("axis_weight", axis_weight,
           {.meaning = "α₃, keeps the hinge axes of seven bones with their parents",
            .min = 0,
            .max = 1e9,
            .origin = Origin::kPaper,
            .source = "paper A, eq. 7"});
  f.Number(
      "length_unit_m", length_unit_m,
      {.meaning = "the length that counts as 1 where squared lengths are weighed against "
                  "squared rotation entries",
       .unit = "m",
       .min = 1e-4,
       .max = 10,
       .origin = Origin::kTuned,
       .source =
           "paper A is silent. On realtime_scape/fig11 0.03 … 0.08 all meet the paper's figures; "
           "at 1 the inertia lags (16 mm mean error), at 0.01 limbs twist (171 mm maximum)"});
}

}  // namespace vitruvia::realtime_scape
