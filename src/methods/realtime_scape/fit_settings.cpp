// The settings of term 1 and of its correspondences.
#include "methods/realtime_scape/settings.h"

namespace vitruvia::realtime_scape {

NearnessSettings NearnessOf(const FitSettings& settings) {
  return {static_cast<float>(settings.near_surface_m), settings.edge_px,
          static_cast<float>(settings.smooth_m), settings.behind_surface};
}

void FitSettings::Describe(Fields& f) {
  f.Choice(
      "surface_residual", surface_residual,
      {{"depth", SurfaceResidual::kDepth}, {"plane", SurfaceResidual::kPlane}},
      {.meaning = "residual of a V1 vertex: its distance from the captured surface in depth or "
                  "along the vertex's normal",
       .origin = Origin::kTuned,
       .source = "paper A: depth; see the report of realtime_scape/fig11"});
  f.Choice(
      "pair_residual", pair_residual,
      {{"point", PairResidual::kPoint}, {"plane", PairResidual::kPlane}},
      {.meaning = "residual of a V2 or P2 pair: its distance in three coordinates or along the "
                  "vertex's normal",
       .origin = Origin::kPaper,
       .source = "paper A, sec. 6.2: three rows each"});
  DescribeVisibility(f);
  DescribeClasses(f);
  DescribePairs(f);
  DescribeWeights(f);
}

void FitSettings::DescribeVisibility(Fields& f) {
  f.Choice("rasterizer", rasterizer,
           {{"all_triangles", Rasterizer::kAllTriangles}, {"front_faces", Rasterizer::kFrontFaces}},
           {.meaning = "which triangles are rendered for the model's depth",
            .origin = Origin::kTuned,
            .source = "the same depth for a closed mesh in less time"});
  f.Integer("visibility_iterations", visibility_iterations,
            {.meaning = "number of iterations of a frame that render the model; later ones reuse "
                        "the last rendering",
             .min = 1,
             .max = 1000,
             .origin = Origin::kPaper,
             .source = "paper A, algorithm 1, line 5: in each"});
  f.Number(
      "visible_within_m", visible_within_m,
      {.meaning = "a vertex is visible when its depth differs from the rendered depth at its pixel "
                  "by less",
       .unit = "m",
       .min = 1e-5,
       .max = 1,
       .origin = Origin::kPaper,
       .source = "paper A, sec. 6.2"});
}

void FitSettings::DescribeClasses(Fields& f) {
  f.Number("near_surface_m", near_surface_m,
           {.meaning = "largest difference in depth at which a visible vertex is near the captured "
                       "surface (V1) and a captured pixel is explained by the rendered one (P1)",
            .unit = "m",
            .min = 1e-4,
            .max = 1,
            .origin = Origin::kTuned,
            .source = "paper A is silent"});
  f.Integer(
      "edge_px", edge_px,
      {.meaning =
           "a vertex or point that is near in depth to any pixel within this many columns and "
           "rows is neither V2 nor P2",
       .unit = "px",
       .min = 0,
       .max = 8,
       .origin = Origin::kTuned,
       .source = "paper A: 0; pairs at silhouettes then move a model that fits"});
  f.Choice(
      "behind_surface", behind_surface,
      {{"elsewhere", BehindSurface::kElsewhere}, {"hidden", BehindSurface::kHidden}},
      {.meaning = "class of a visible vertex behind the captured surface: V2, or hidden by another "
                  "part of the body and ignored",
       .origin = Origin::kTuned,
       .source = "paper A: V2; a limb that vanishes behind the body is then dragged along"});
  f.Number("smooth_m", smooth_m,
           {.meaning =
                "captured depth is interpolated between pixels whose depths differ by at most this",
            .unit = "m",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = "paper A is silent; 0 takes the nearest pixel"});
}

void FitSettings::DescribePairs(Fields& f) {
  f.Choice(
      "association", association,
      {{"kd_tree", Association::kKdTree},
       {"window", Association::kWindow},
       {"exhaustive", Association::kExhaustive}},
      {.meaning = "search for the nearest points and vertices of V2 and P2: by trees, in a window "
                  "of the image, or over all",
       .origin = Origin::kTuned,
       .source = "paper A: kd_tree; there are few queries, so that building trees costs more "
                 "than it saves"});
  if (f.Applies(association == Association::kWindow)) {
    f.Integer(
        "window_px", window_px,
        {.meaning = "maximum half width of the image window in which nearest points are searched",
         .unit = "px",
         .min = 0,
         .max = 4096,
         .origin = Origin::kGuessed,
         .source = "0.08 m at 1 m and 320 columns"});
  }
  f.Number("pair_cutoff_m", pair_cutoff_m,
           {.meaning = "V2 and P2 pairs with a larger distance are dropped",
            .unit = "m",
            .min = 1e-4,
            .max = 1,
            .origin = Origin::kTuned,
            .source = "paper A, sec. 6.2: 0.02, which loses a hand faster than 0.6 m/s"});
}

void FitSettings::DescribeWeights(Fields& f) {
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
  f.Integer(
      "surface_stride", surface_stride,
      {.meaning =
           "stride of the V1 vertices that get a row; the rows' weight is multiplied by the stride",
       .min = 1,
       .max = 64,
       .origin = Origin::kPaper,
       .source = "paper A: 1"});
  f.Integer("average_px", average_px,
            {.meaning = "a V1 vertex is compared with the mean of captured minus rendered depth "
                        "over the pixels within this many columns and rows, so that a mesh that is "
                        "coarser than the image makes use of all pixels; 0: with the captured "
                        "depth at its pixel alone, as in iterations that do not render",
             .unit = "px",
             .min = 0,
             .max = 16,
             .origin = Origin::kPaper,
             .source = "paper A: 0"});
  f.Number("pixel_sharing", pixel_sharing,
           {.meaning = "extent to which the V1 vertices in one pixel share its weight, so that the "
                       "noise of a pixel counts once where the mesh is denser than the image: the "
                       "row of each of n vertices weighs 1 - extent + extent / n",
            .min = 0,
            .max = 1,
            .origin = Origin::kPaper,
            .source = "paper A: 0"});
  f.Choice("kernel", kernel,
           {{"none", RobustKernel::kNone},
            {"huber", RobustKernel::kHuber},
            {"tukey", RobustKernel::kTukey}},
           {.meaning = "robust kernel that reduces the influence of large residuals",
            .origin = Origin::kTuned,
            .source = "paper A: none; on configs/cmu/walk.json (diagonal) huber more than halves "
                      "the mean error"});
  if (f.Applies(kernel != RobustKernel::kNone)) {
    f.Number(
        "kernel_scale_m", kernel_scale_m,
        {.meaning = "residual from which the robust kernel reduces a row's influence (huber) or at "
                    "which none is left (tukey)",
         .unit = "m",
         .min = 1e-6,
         .max = 10,
         .origin = Origin::kGuessed,
         .source = "paper A is silent"});
  }
  f.Section("noise", noise,
            {.meaning = "expected standard deviations, which determine the rows' weights"});
  f.Section("free_space", free_space,
            {.meaning = "visible vertices where the frame shows that nothing is: before the "
                        "captured surface or beside it"});
}

void NoiseSettings::Describe(Fields& f) {
  f.Visit(sensor);
  f.Number(
      "model_deviation_m", model_deviation_m,
      {.meaning = "standard deviation of the distance between the model's surface and the true "
                  "one, with which the sensor's noise is compared",
       .unit = "m",
       .min = 1e-5,
       .max = 1,
       .origin = Origin::kGuessed,
       .source = "skinning is some millimetres off"});
}

void FreeSpaceSettings::Describe(Fields& f) {
  f.Integer(
      "margin_px", margin_px,
      {.meaning = "a vertex that projects this near to a measurement, or to the border of the "
                  "image, is not beside the captured surface",
       .unit = "px",
       .min = 0,
       .max = 64,
       .origin = Origin::kGuessed,
       .source = "edges lose their measurements"});
  f.Number("reach_m", reach_m,
           {.meaning = "maximum distance across the line of sight at which the captured surface or "
                       "the border of the image is searched from a vertex beside the surface",
            .unit = "m",
            .min = 0.01,
            .max = 2,
            .origin = Origin::kGuessed,
            .source = "a limb that is farther off is not where it is sought"});
}

void SearchSettings::Describe(Fields& f) {
  f.Choice(
      "candidates", candidates,
      {{"visible", PairCandidates::kVisible}, {"reach", PairCandidates::kReach}},
      {.meaning = "vertices with which a point of P2 may be paired: every visible one, or those of "
                  "bones that are not well explained, unobserved bones included",
       .origin = Origin::kTuned,
       .source = "paper A: visible; a hand that appears from behind the body is then paired "
                 "with the body"});
  if (!f.Applies(candidates == PairCandidates::kReach)) return;
  f.Number("seen_share", seen_share,
           {.meaning =
                "a bone is observed in a frame when at least this share of all its vertices is V1",
            .min = 0,
            .max = 1,
            .origin = Origin::kTuned,
            .source = "about 0.4 of a bone's vertices face the camera"});
  f.Number(
      "well_explained_share", well_explained_share,
      {.meaning = "a bone is well explained, and gets no points of P2, when more than this share "
                  "of its visible vertices is V1",
       .min = 0,
       .max = 1,
       .origin = Origin::kTuned,
       .source = "configs/cmu/walk.json"});
  f.Number("owned_m", owned_m,
           {.meaning =
                "a point of P2 this close to a well explained bone belongs to it and is not paired",
            .unit = "m",
            .min = 0,
            .max = 10,
            .origin = Origin::kTuned,
            .source = "configs/cmu/walk.json: skin differs by some centimetres at silhouettes"});
  f.Number(
      "growth_m", growth_m,
      {.meaning = "growth of a bone's search radius, which starts at pair_cutoff_m, per frame in "
                  "which the bone is not observed",
       .unit = "m",
       .min = 0,
       .max = 10,
       .origin = Origin::kTuned,
       .source = "configs/cmu/walk.json"});
  f.Number("reach_m", reach_m,
           {.meaning = "upper bound of a bone's search radius",
            .unit = "m",
            .min = 0,
            .max = 10,
            .origin = Origin::kTuned,
            .source = "configs/cmu/walk.json"});
}

}  // namespace vitruvia::realtime_scape
