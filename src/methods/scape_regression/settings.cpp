#include "methods/scape_regression/settings.h"

#include <fmt/format.h>

#include "tracking/frame_checks.h"

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
           {.meaning = "largest distance between paired points of the two contours",
            .unit = "m",
            .min = 1e-3,
            .max = 10.0,
            .origin = Origin::kGuessed});
  f.Integer("stride", stride,
            {.meaning = "stride of the points of the observed contour that are used",
             .min = 1,
             .max = 100,
             .origin = Origin::kGuessed});
  f.Integer("margin_px", margin_px,
            {.meaning = "a vertex at a fold between front and back faces is on the contour if the "
                        "rendered model has an empty pixel within this distance",
             .unit = "px",
             .min = 1,
             .max = 50,
             .origin = Origin::kGuessed});
}

void FitSettings::Describe(Fields& f) {
  f.Integer("iterations", iterations,
            {.meaning = "maximum number of steps for a frame",
             .min = 0,
             .max = 10000,
             .origin = Origin::kGuessed,
             .source = "Weiss et al. 2011 take about an hour for a pose (paper A)"});
  f.Integer("first_frame_iterations", first_frame_iterations,
            {.meaning = "maximum number of steps for the first frame",
             .min = 0,
             .max = 10000,
             .origin = Origin::kGuessed});
  f.Number("first_kernel_m", first_kernel_m,
           {.meaning = "scale of the Geman–McClure kernel of all residuals in a frame's first step",
            .unit = "m",
            .min = 1e-3,
            .max = 10.0,
            .origin = Origin::kGuessed});
  f.Number("last_kernel_m", last_kernel_m,
           {.meaning = "scale of the Geman–McClure kernel in the second half of a frame's steps; "
                       "in the first half it falls geometrically",
            .unit = "m",
            .min = 1e-3,
            .max = 10.0,
            .origin = Origin::kGuessed});
  f.Number("pose_change_weight", pose_change_weight,
           {.meaning = "weight of a joint's rotation by 0.1 rad since the last frame, relative to "
                       "a mean squared residual of 1 mm²",
            .min = 0.0,
            .max = 1e6,
            .origin = Origin::kGuessed});
  f.Number("pose_weight", pose_weight,
           {.meaning = "weight of a joint's rotation by one standard deviation of captured motion "
                       "from its mean, relative to a mean squared residual of 1 mm²",
            .min = 0.0,
            .max = 1e6,
            .origin = Origin::kGuessed,
            .source = "Weiss et al. 2011 have a prior on pose; recalled, its form is open"});
  f.Number("prediction", prediction,
           {.meaning = "share of the last frame's motion that is predicted for the next frame, "
                       "unless the last frame was lost",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed,
            .source = "Weiss et al. 2011 fit single poses; as the other methods"});
  f.Number("stop_rad", stop_rad,
           {.meaning = "iterations stop when every part rotated by less in a step",
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
  DescribeMaxDepth(f, max_depth_m);
  f.Number("lost_below", lost_below,
           {.meaning = "a frame is lost if a smaller share of the visible vertices lies within the "
                       "last kernel's scale of the observed depth",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
}

}  // namespace vitruvia::scape_regression
