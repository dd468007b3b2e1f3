// The settings of term 1 and of what its points may pull at.
#include "methods/realtime_scape/settings.h"

namespace vitruvia::realtime_scape {

void FitSettings::Describe(Fields& f) {
  f.Choice("surface_residual", surface_residual,
           {{"depth", SurfaceResidual::kDepth}, {"plane", SurfaceResidual::kPlane}},
           {.meaning = "what a V1 vertex is asked to do: match the captured depth, or the captured "
                       "surface along its normal",
            .origin = Origin::kTuned,
            .source = "paper A: depth; see the report of realtime_scape/fig11"});
  f.Choice("pair_residual", pair_residual,
           {{"point", PairResidual::kPoint}, {"plane", PairResidual::kPlane}},
           {.meaning = "what a V2 or P2 pair is asked to do: meet, or meet along the vertex's "
                       "normal",
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
           {.meaning = "how the model's depth is drawn",
            .origin = Origin::kTuned,
            .source = "the same picture of a closed mesh in less time"});
  f.Integer("visibility_iterations", visibility_iterations,
            {.meaning = "the model is drawn anew in so many iterations of a frame; later ones use "
                        "the last drawing",
             .min = 1,
             .max = 1000,
             .origin = Origin::kPaper,
             .source = "paper A, algorithm 1, line 5: in each"});
  f.Number("visible_within_m", visible_within_m,
           {.meaning = "a vertex is visible this close to the rendered depth at its pixel",
            .unit = "m",
            .min = 1e-5,
            .max = 1,
            .origin = Origin::kPaper,
            .source = "paper A, sec. 6.2"});
}

void FitSettings::DescribeClasses(Fields& f) {
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
  f.Choice("behind_surface", behind_surface,
           {{"elsewhere", BehindSurface::kElsewhere}, {"hidden", BehindSurface::kHidden}},
           {.meaning = "what a visible vertex behind the captured surface is: V2, or hidden by "
                       "another part of the body and left alone",
            .origin = Origin::kTuned,
            .source = "paper A: V2; a limb that vanishes behind the body is then dragged along"});
  f.Number("smooth_m", smooth_m,
           {.meaning = "captured depth is interpolated between pixels that differ by no more",
            .unit = "m",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = "paper A is silent; 0 takes the nearest pixel"});
}

void FitSettings::DescribePairs(Fields& f) {
  f.Choice("association", association,
           {{"kd_tree", Association::kKdTree},
            {"window", Association::kWindow},
            {"exhaustive", Association::kExhaustive}},
           {.meaning = "how the nearest points and vertices of V2 and P2 are found: by trees, in a "
                       "window of the image, or by looking at all",
            .origin = Origin::kTuned,
            .source = "paper A: kd_tree; few queries are left, so that building trees costs more "
                      "than it saves"});
  if (f.Applies(association == Association::kWindow)) {
    f.Integer("window_px", window_px,
              {.meaning = "half width of the window at most",
               .unit = "px",
               .min = 0,
               .max = 4096,
               .origin = Origin::kGuessed,
               .source = "0.08 m at 1 m and 320 columns"});
  }
  f.Number("pair_cutoff_m", pair_cutoff_m,
           {.meaning = "V2 and P2 pairs farther apart are dropped",
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
  f.Integer("surface_stride", surface_stride,
            {.meaning = "every how many vertices of V1 one gets a row, of as many times the weight",
             .min = 1,
             .max = 64,
             .origin = Origin::kPaper,
             .source = "paper A: 1"});
  f.Choice("kernel", kernel,
           {{"none", RobustKernel::kNone},
            {"huber", RobustKernel::kHuber},
            {"tukey", RobustKernel::kTukey}},
           {.meaning = "how rows that do not fit lose influence",
            .origin = Origin::kTuned,
            .source = "paper A: none; on configs/cmu/walk.json (diagonal) huber more than halves "
                      "the mean error"});
  if (f.Applies(kernel != RobustKernel::kNone)) {
    f.Number(
        "kernel_scale_m", kernel_scale_m,
        {.meaning = "residual at which a row begins to lose influence (huber) or has none left "
                    "(tukey)",
         .unit = "m",
         .min = 1e-6,
         .max = 10,
         .origin = Origin::kGuessed,
         .source = "paper A is silent"});
  }
}

void SearchSettings::Describe(Fields& f) {
  f.Choice("candidates", candidates,
           {{"visible", PairCandidates::kVisible}, {"reach", PairCandidates::kReach}},
           {.meaning = "what a point of P2 may pull at: every visible vertex, or those of bones "
                       "that lack points of their own, unseen ones too",
            .origin = Origin::kTuned,
            .source = "paper A: visible; a hand that comes out from behind the body then pulls at "
                      "the body"});
  if (!f.Applies(candidates == PairCandidates::kReach)) return;
  f.Number("seen_share", seen_share,
           {.meaning = "a bone is seen when this share of all its vertices is V1",
            .min = 0,
            .max = 1,
            .origin = Origin::kTuned,
            .source = "about 0.4 of a bone's vertices face the camera"});
  f.Number("settled_share", settled_share,
           {.meaning = "a bone is settled, and takes no points of P2, when more than this share of "
                       "its visible vertices is V1",
            .min = 0,
            .max = 1,
            .origin = Origin::kTuned,
            .source = "configs/cmu/walk.json"});
  f.Number(
      "owned_m", owned_m,
      {.meaning = "a point of P2 this close to a settled bone is that bone's and pulls at none",
       .unit = "m",
       .min = 0,
       .max = 10,
       .origin = Origin::kTuned,
       .source = "configs/cmu/walk.json: skin differs by some centimetres at silhouettes"});
  f.Number("growth_m", growth_m,
           {.meaning = "the cutoff of a bone's pairs grows by this for each frame in which it was "
                       "not seen",
            .unit = "m",
            .min = 0,
            .max = 10,
            .origin = Origin::kTuned,
            .source = "configs/cmu/walk.json"});
  f.Number("reach_m", reach_m,
           {.meaning = "and to this at most",
            .unit = "m",
            .min = 0,
            .max = 10,
            .origin = Origin::kTuned,
            .source = "configs/cmu/walk.json"});
}

}  // namespace vitruvia::realtime_scape
