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

void FitSettings::Describe(Fields& f) {
  f.Choice("surface_residual", surface_residual,
           {{"depth", SurfaceResidual::kDepth}, {"plane", SurfaceResidual::kPlane}},
           {.meaning = "what a V1 vertex is asked to do: match the captured depth, or the captured "
                       "surface along its normal",
            .origin = Origin::kTuned,
            .source = "paper A: depth; see the report of realtime_scape/fig11"});
  f.Number("visible_within_m", visible_within_m,
           {.meaning = "a vertex is visible this close to the rendered depth at its pixel",
            .unit = "m",
            .min = 1e-5,
            .max = 1,
            .origin = Origin::kPaper,
            .source = "paper A, sec. 6.2"});
  f.Number("near_surface_m", near_surface_m,
           {.meaning = "a visible vertex this close in depth to the captured pixel is V1, and a "
                       "captured pixel this close to the rendered depth is explained (P1)",
            .unit = "m",
            .min = 1e-4,
            .max = 1,
            .origin = Origin::kTuned,
            .source = "paper A is silent"});
  f.Integer(
      "edge_px", edge_px,
      {.meaning =
           "a vertex or point that is near within this many columns and rows is neither V2 nor P2",
       .unit = "px",
       .min = 0,
       .max = 8,
       .origin = Origin::kTuned,
       .source = "paper A: 0; pairs at silhouettes then pull at a model that fits"});
  f.Number("smooth_m", smooth_m,
           {.meaning = "captured depth is interpolated between pixels that differ by no more",
            .unit = "m",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = "paper A is silent; 0 takes the nearest pixel"});
  f.Number("pair_cutoff_m", pair_cutoff_m,
           {.meaning = "V2 and P2 pairs farther apart are dropped",
            .unit = "m",
            .min = 1e-4,
            .max = 1,
            .origin = Origin::kTuned,
            .source = "paper A, sec. 6.2: 0.02, which loses a hand faster than 0.6 m/s"});
  f.Number("surface_weight", surface_weight,
           {.meaning = "weight of each V1 row",
            .min = 0,
            .max = 1e6,
            .origin = Origin::kPaper,
            .source = "paper A, eq. 7"});
  f.Number("pair_weight", pair_weight,
           {.meaning = "weight of each V2 and P2 row",
            .min = 0,
            .max = 1e6,
            .origin = Origin::kPaper,
            .source = "paper A, eq. 7"});
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
  f.Number("relative_tolerance", relative_tolerance,
           {.meaning = "conjugate gradients stop when the residual has fallen by this factor",
            .min = 1e-15,
            .max = 0.5,
            .origin = Origin::kGuessed,
            .source = "paper A is silent"});
  f.Integer("max_iterations", max_iterations,
            {.meaning = "conjugate gradient iterations at most",
             .min = 1,
             .max = 10000,
             .origin = Origin::kGuessed,
             .source = "twice the 102 unknowns"});
  f.Number(
      "damping", damping,
      {.meaning = "added to the diagonal of the normal equations (energy per rad² or length unit²)",
       .min = 0,
       .max = 1e9,
       .origin = Origin::kGuessed,
       .source = "keeps the system regular when nothing at all is seen"});
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
}

void Settings::Describe(Fields& f) {
  f.Section("cloud", cloud, {.meaning = "the observed points P"});
  f.Section("fit", fit, {.meaning = "term 1, goodness of fit"});
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
  f.Section("stopping", stopping, {.meaning = "when a frame is done"});
  f.Section("solver", solver, {.meaning = "conjugate gradients"});
  f.Section("placement", placement, {.meaning = "how the rest pose is put onto the first frame"});
  f.Number("lost_below", lost_below,
           {.meaning =
                "a frame is lost when less than this share of the cloud is explained by the model",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = "paper A is silent"});
}

}  // namespace vitruvia::realtime_scape
