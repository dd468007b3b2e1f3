#include "methods/dynamic/settings.h"

#include <fmt/format.h>

namespace vitruvia::dynamic {

void AssociationSettings::Describe(Fields& f) {
  f.Integer("window_px", window_px,
            {.meaning = "half width, in columns and rows, of the window round a point's pixel in "
                        "which its closest vertex is searched",
             .unit = "px",
             .min = 0,
             .max = 1000,
             .origin = Origin::kGuessed,
             .source = "paper B is silent; holds the cutoff's 0.12 m at 1.4 m and 365 px of focal "
                       "length"});
  f.Number("cutoff_m", cutoff_m,
           {.meaning = "largest distance of a point from its vertex in a frame's first iteration",
            .unit = "m",
            .min = 1e-4,
            .max = 10,
            .origin = Origin::kGuessed,
            .source = "paper B is silent; a hand at 3.6 m/s between frames of 30 Hz"});
  f.Number("last_cutoff_m", last_cutoff_m,
           {.meaning = "largest distance of a point from its vertex in a frame's last iteration; "
                       "between cutoff_m and this it falls geometrically",
            .unit = "m",
            .min = 1e-4,
            .max = 10,
            .origin = Origin::kTuned,
            .source = "paper B is silent; with cutoff_m throughout, hands before the face carry "
                      "the head away: dynamic_close is off by 4.0 mm, by 1.6 with 0.02. For the "
                      "noise of a Kinect v1 0.03 is better (ablations/dynamic_cutoff)"});
  f.Number("facing_cosine", facing_cosine,
           {.meaning = "minimum cosine of the angle between a vertex's normal and the line of "
                       "sight for the vertex to be paired",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = "paper B is silent"});
  f.Integer("pose_pixel_stride", pose_pixel_stride,
            {.meaning = "stride in columns and rows of the pixels that the pose step uses; the "
                        "shape step uses all pixels",
             .unit = "px",
             .min = 1,
             .max = 16,
             .origin = Origin::kPaper,
             .source = "paper B: all; more is ours, coarse to fine"});
  f.Integer("pose_vertex_stride", pose_vertex_stride,
            {.meaning = "the pose step uses about one of this many vertices, evenly spread; the "
                        "shape step uses all vertices",
             .min = 1,
             .max = 64,
             .origin = Origin::kPaper,
             .source = "paper B: all; more is ours, coarse to fine"});
}

std::string AssociationSettings::Problem() const {
  if (last_cutoff_m <= cutoff_m) return "";
  return fmt::format("last_cutoff_m is {:g} m: expected at most cutoff_m, {:g} m", last_cutoff_m,
                     cutoff_m);
}

void PoseSettings::Describe(Fields& f) {
  f.Integer("iterations", iterations,
            {.meaning = "maximum number of pose iterations for a frame",
             .min = 0,
             .max = 1000,
             .origin = Origin::kPaper,
             .source = "paper B, sec. 4.2: ten to fifteen"});
  f.Integer("first_frame_iterations", first_frame_iterations,
            {.meaning = "maximum number of pose iterations for the first frame",
             .min = 0,
             .max = 1000,
             .origin = Origin::kGuessed,
             .source = "paper B is silent"});
  f.Number("prediction", prediction,
           {.meaning = "share of each joint's last motion that is predicted for the next frame",
            .min = 0,
            .max = 1,
            .origin = Origin::kTuned,
            .source = "paper B starts from the last pose, 0: then boxing arms are lost within 40 "
                      "frames of dynamic_close, which 0.8 follows"});
  f.Number("damping", damping,
           {.meaning = "λ of the damped least squares, per rad² and m² of a joint",
            .min = 0,
            .max = 1e9,
            .origin = Origin::kTuned,
            .source = "paper B is silent; 0.002 … 0.01 do alike on dynamic_far"});
  f.Number("default_pose_weight", default_pose_weight,
           {.meaning = "γ: weight of the prior that pulls each joint to its default 0, times the "
                       "number of vertices that the joint moves",
            .min = 0,
            .max = 1e9,
            .origin = Origin::kTuned,
            .source = "paper B is silent; on 80 frames of dynamic_far the elbows are off by 91 mm "
                      "at most at 1e-5, by 21 at 1e-6, and all joints more again at 1e-7"});
  f.Number("freeze_below_share", freeze_below_share,
           {.meaning = "a joint is frozen while a smaller share of the vertices that it moves is "
                       "paired with points",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = "paper B lets it relax to the default pose, as 0 does"});
  f.Number("rotation_step_deg", rotation_step_deg,
           {.meaning = "stop when every hinge rotated by less in an iteration, whatever the "
                       "current cutoff; 0: never",
            .unit = "deg",
            .min = 0,
            .max = 180,
            .origin = Origin::kGuessed,
            .source = "paper B: a fixed number of iterations"});
  f.Number("translation_step_m", translation_step_m,
           {.meaning = "stop when every prismatic joint moved by less in an iteration; 0: never",
            .unit = "m",
            .min = 0,
            .max = 10,
            .origin = Origin::kGuessed,
            .source = "paper B: a fixed number of iterations"});
}

void ShapeSettings::Describe(Fields& f) {
  f.Integer("iterations", iterations,
            {.meaning = "shape iterations for a frame",
             .min = 0,
             .max = 1000,
             .origin = Origin::kPaper,
             .source = "paper B, sec. 4.3: two"});
  f.Integer("first_frame_iterations", first_frame_iterations,
            {.meaning = "shape iterations for the first frame, whose warps begin at 0",
             .min = 0,
             .max = 1000,
             .origin = Origin::kGuessed,
             .source = "paper B is silent; shape match has no other frame to fit"});
  f.Number("cutoff_m", cutoff_m,
           {.meaning = "largest distance of a point from its vertex in the shape step",
            .unit = "m",
            .min = 1e-4,
            .max = 10,
            .origin = Origin::kGuessed,
            .source = "paper B is silent; deeper than cloth folds, nearer than the next limb"});
  f.Number("magnitude_weight", magnitude_weight,
           {.meaning = "λ_d of eq. 9: weight of the squared length of warps",
            .min = 0,
            .max = 1e6,
            .origin = Origin::kGuessed,
            .source = "paper B is silent"});
  f.Number("neighbor_weight", neighbor_weight,
           {.meaning = "λ_s of eq. 9: weight of the squared difference of neighbouring warps",
            .min = 1e-9,
            .max = 1e6,
            .origin = Origin::kGuessed,
            .source = "paper B is silent"});
}

void PlacementSettings::Describe(Fields& f) {
  f.Integer("iterations", iterations,
            {.meaning = "number of iterations of the root's joints alone that align the rest pose "
                        "with the first frame",
             .min = 0,
             .max = 1000,
             .origin = Origin::kGuessed,
             .source = "paper B starts from a given estimate"});
  f.Integer("window_px", window_px,
            {.meaning = "window_px of the association while placing",
             .unit = "px",
             .min = 0,
             .max = 1000,
             .origin = Origin::kGuessed,
             .source = "as far as the first estimate may be off"});
  f.Number("cutoff_m", cutoff_m,
           {.meaning = "cutoff_m of the association while placing",
            .unit = "m",
            .min = 1e-4,
            .max = 10,
            .origin = Origin::kGuessed,
            .source = "as far as the first estimate may be off"});
}

void Settings::Describe(Fields& f) {
  f.File("skeleton", skeleton,
         {.meaning = "skeleton file: joints, axes and limits", .required = true});
  f.Choice("mode", mode,
           {{"full", Mode::kFull},
            {"shape_match", Mode::kShapeMatch},
            {"smooth_bind", Mode::kSmoothBind},
            {"rigid", Mode::kRigid}},
           {.meaning = "warps of the surface: estimated in every frame, in the first frame only, "
                       "none, or none with rigid parts",
            .origin = Origin::kPaper,
            .source = "paper B, sec. 5.1"});
  f.Section("association", association, {.meaning = "association of points with vertices"});
  f.Section("pose", pose, {.meaning = "damped least squares over the joints"});
  f.Section("shape", shape, {.meaning = "warps of the vertices"});
  DescribeStart(f, start);
  f.Section("placement", placement, {.meaning = "alignment of the rest pose with the first frame"});
  f.Section(
      "watch", watch,
      {.meaning = "detection of a lost subject by the areas in which model and frame disagree"});
  if (f.Applies(start == Start::kSearch || watch.lost_above > 0.0)) {
    f.Section("start_search", start_search,
              {.meaning = "search for the first pose, or for a subject that is not tracked"});
  }
  f.Section("limbs", limbs, {.meaning = "search for limbs that moved away from the model"});
  if (f.Applies(watch.lost_above > 0.0 || limbs.min_unexplained_m2 > 0.0)) {
    f.Integer("area_edge_px", area_edge_px,
              {.meaning = "where areas are compared, a point counts as explained if the model is "
                          "near it in depth within this many columns and rows",
               .unit = "px",
               .min = 0,
               .max = 100,
               .origin = Origin::kGuessed,
               .source = "half a pixel of error at silhouettes; clothes are several pixels wide"});
  }
  f.Section("facing", facing, {.meaning = "search for a body that is tracked back to front"});
  f.Section("uncertainty", uncertainty,
            {.meaning = "covariances of the joints, from the normal equations"});
  DescribeMaxDepth(f, max_depth_m);
  f.Number("lost_below", lost_below,
           {.meaning = "a frame is lost, and pose and shape are kept, when less than this share of "
                       "the points was paired with a vertex even in its best iteration",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = "paper B is silent"});
  DescribeLeastPoints(f, least_points);
  f.Integer("threads", threads,
            {.meaning = "threads that a frame is computed on; the result does not depend on it",
             .min = 1,
             .max = 64,
             .origin = Origin::kInput,
             .source = "two cores"});
}

}  // namespace vitruvia::dynamic
