#include "methods/scape_regression/settings.h"

#include <fmt/format.h>

namespace vitruvia::scape_regression {

void DepthTermSettings::Describe(Fields& f) {
  f.Number("facing_cosine", facing_cosine,
           {.meaning = "a vertex's depth is compared only if the angle between its normal and the "
                       "line of sight has at least this cosine",
            .min = 0.01,
            .max = 1.0,
            .origin = Origin::kGuessed,
            .source = "Weiss et al. 2011, the body of which was not at hand"});
  f.Number("weight", weight,
           {.meaning = "weight of the mean squared difference in depth",
            .min = 0.0,
            .max = 1e6,
            .origin = Origin::kGuessed,
            .source = "Weiss et al. 2011, the body of which was not at hand"});
}

void ContourTermSettings::Describe(Fields& f) {
  f.Number("weight", weight,
           {.meaning = "weight of the mean squared distances between the contours, both ways",
            .min = 0.0,
            .max = 1e6,
            .origin = Origin::kGuessed,
            .source = "Weiss et al. 2011, the body of which was not at hand"});
  f.Number("cutoff_m", cutoff_m,
           {.meaning = "points of the two contours farther from each other than this are no pair",
            .unit = "m",
            .min = 1e-3,
            .max = 10.0,
            .origin = Origin::kGuessed});
  f.Integer("stride", stride,
            {.meaning = "one of that many points of the observed contour is used",
             .min = 1,
             .max = 100,
             .origin = Origin::kGuessed});
  f.Integer(
      "margin_px", margin_px,
      {.meaning = "a vertex where the surface turns away is on the contour if the model leaves "
                  "a pixel within this distance empty",
       .unit = "px",
       .min = 1,
       .max = 50,
       .origin = Origin::kGuessed});
}

void FitSettings::Describe(Fields& f) {
  f.Integer("iterations", iterations,
            {.meaning = "steps for a frame at most",
             .min = 0,
             .max = 10000,
             .origin = Origin::kGuessed,
             .source = "Weiss et al. 2011 take about an hour for a pose (paper A)"});
  f.Integer("first_frame_iterations", first_frame_iterations,
            {.meaning = "steps for the first frame at most",
             .min = 0,
             .max = 10000,
             .origin = Origin::kGuessed});
  f.Number("first_kernel_m", first_kernel_m,
           {.meaning = "scale of the Geman–McClure kernel of all residuals in a frame's first step",
            .unit = "m",
            .min = 1e-3,
            .max = 10.0,
            .origin = Origin::kGuessed});
  f.Number(
      "last_kernel_m", last_kernel_m,
      {.meaning = "scale of the Geman–McClure kernel from the middle of a frame's steps on; until "
                  "then it falls by the same factor each time",
       .unit = "m",
       .min = 1e-3,
       .max = 10.0,
       .origin = Origin::kGuessed});
  f.Number("pose_change_weight", pose_change_weight,
           {.meaning = "weight of a joint's turn of 0.1 rad since the last frame, against a mean "
                       "squared residual of 1 mm²",
            .min = 0.0,
            .max = 1e6,
            .origin = Origin::kGuessed});
  f.Number("pose_weight", pose_weight,
           {.meaning = "weight of a joint's turn of one standard deviation of captured motion away "
                       "from its mean, against a mean squared residual of 1 mm²",
            .min = 0.0,
            .max = 1e6,
            .origin = Origin::kGuessed,
            .source = "Weiss et al. 2011 have a prior on pose; recalled, its form is open"});
  f.Number("prediction", prediction,
           {.meaning =
                "share of the last frame's motion that a frame begins with, unless that frame was "
                "lost",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed,
            .source = "Weiss et al. 2011 fit single poses; as the other methods"});
  f.Number("stop_rad", stop_rad,
           {.meaning = "stop when every part turned by less in a step",
            .unit = "rad",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
}

std::string FitSettings::Problem() const {
  if (last_kernel_m <= first_kernel_m) return "";
  return fmt::format("last_kernel_m is {:g} m: expected at most first_kernel_m, {:g} m",
                     last_kernel_m, first_kernel_m);
}

void Settings::Describe(Fields& f) {
  f.File("regression", regression,
         {.meaning = "folder of a pose regression (vitruvia learn pose-regression)",
          .required = true});
  f.Section("depth", depth, {.meaning = "difference in depth"});
  f.Section("contour", contour, {.meaning = "distance between contours"});
  f.Section("fit", fit, {.meaning = "nonlinear least squares"});
  f.Number("visible_within_m", visible_within_m,
           {.meaning = "a vertex is visible within this of the rendered depth",
            .unit = "m",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kPaper,
            .source = "paper A, sec. 6.2"});
  DescribeStart(f, start);
  f.Section("placement", placement, {.meaning = "first placement of the rest pose"});
  if (f.Applies(start == Start::kSearch)) {
    f.Section("start_search", start_search, {.meaning = "search for the first pose"});
  }
  f.Number("max_depth_m", max_depth_m,
           {.meaning = "pixels beyond this are no measurement",
            .unit = "m",
            .min = 0.1,
            .max = 100.0,
            .origin = Origin::kGuessed});
  f.Number(
      "lost_below", lost_below,
      {.meaning = "lost if a smaller share of the visible vertices lies within the last kernel "
                  "of the depth",
       .min = 0.0,
       .max = 1.0,
       .origin = Origin::kGuessed});
}

}  // namespace vitruvia::scape_regression
