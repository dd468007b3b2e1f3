#include "articulated/settings.h"

#include <algorithm>
#include <cmath>

#include "tracking/frame_checks.h"

namespace vitruvia::articulated {

void StoppingSettings::Describe(Fields& f) {
  f.Integer("iterations", iterations,
            {.meaning = "maximum number of iterations for a frame",
             .min = 1,
             .max = 1000,
             .origin = Origin::kGuessed,
             .source = "the methods' papers give 5 to 15"});
  f.Integer("first_frame_iterations", first_frame_iterations,
            {.meaning = "maximum number of iterations for the first frame, and for each pose that "
                        "relocalisation refines",
             .min = 1,
             .max = 1000,
             .origin = Origin::kGuessed});
  f.Number("rotation_step_deg", rotation_step_deg,
           {.meaning = "iterations stop when no angle has changed by more than this and the pelvis "
                       "has moved by less than translation_step_m",
            .unit = "deg",
            .min = 1e-6,
            .max = 180,
            .origin = Origin::kGuessed});
  f.Number("translation_step_m", translation_step_m,
           {.meaning = "iterations stop when the pelvis has moved by less than this and no angle "
                       "has changed by rotation_step_deg",
            .unit = "m",
            .min = 1e-9,
            .max = 10,
            .origin = Origin::kGuessed});
}

void PredictionSettings::Describe(Fields& f) {
  f.Number("velocity_share", velocity_share,
           {.meaning = "share of the last frame's velocity that is predicted for the next frame",
            .min = 0,
            .max = 1,
            .origin = Origin::kTuned,
            .source = "captured/walk: hidden limbs overshoot at 1, which is constant velocity, the "
                      "second-order prior of Wei 2012"});
  f.Number("angle_deviation_deg", angle_deviation_deg,
           {.meaning = "standard deviation of a joint angle from the predicted one",
            .unit = "deg",
            .min = 0.01,
            .max = 1000,
            .origin = Origin::kTuned,
            .source = "captured/walk and fig11 four times as fast, within 3 to 8 degrees"});
  f.Number("rotation_deviation_deg", rotation_deviation_deg,
           {.meaning = "standard deviation of the body's rotation from the predicted one, about "
                       "each axis",
            .unit = "deg",
            .min = 0.01,
            .max = 1000,
            .origin = Origin::kGuessed});
  f.Number("position_deviation_m", position_deviation_m,
           {.meaning = "standard deviation of the pelvis' position from the predicted one, along "
                       "each axis",
            .unit = "m",
            .min = 1e-4,
            .max = 100,
            .origin = Origin::kGuessed});
}

void DataSettings::Describe(Fields& f) {
  f.Number("deviation_m", deviation_m,
           {.meaning = "standard deviation of a point of the frame from the model, without the "
                       "sensor's noise",
            .unit = "m",
            .min = 1e-4,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = "how far the model is from the person's surface"});
  f.Number("independent_points", independent_points,
           {.meaning = "effective number of independent points in a frame, by which the weights of "
                       "all its points are scaled",
            .min = 1,
            .max = 1e6,
            .origin = Origin::kGuessed,
            .source = "errors of neighbouring points are nearly the same"});
  f.Section("noise", noise, {.meaning = "noise model of the sensor"});
}

double DataSettings::Deviation_m(double depth_m) const {
  return std::sqrt(deviation_m * deviation_m + noise.Variance_m2(depth_m, 1.0));
}

double DataSettings::RowWeight(std::size_t rows, double depth_m) const {
  const double variance = deviation_m * deviation_m + noise.Variance_m2(depth_m, 1.0);
  return independent_points / (std::max<double>(1.0, static_cast<double>(rows)) * variance);
}

void CommonSettings::Describe(Fields& f) {
  f.Integer("stride_px", stride_px,
            {.meaning = "stride in columns and rows of the pixels that become points of the cloud",
             .unit = "px",
             .min = 1,
             .max = 16,
             .origin = Origin::kGuessed});
  DescribeMaxDepth(f, max_depth_m);
  f.Section("stopping", stopping, {.meaning = "stopping rule of the iterations"});
  f.Section("prediction", prediction, {.meaning = "prediction of a frame's pose"});
  f.Section("data", data, {.meaning = "weight of a frame's data relative to the prediction"});
  f.Integer("surface_vertices", surface_vertices,
            {.meaning = "vertices of the subject's surface on which visibility and the agreement "
                        "with the frame are judged",
             .min = 100,
             .max = 1e6,
             .origin = Origin::kGuessed});
  f.Number("near_m", near_m,
           {.meaning = "difference in depth within which model and frame agree at a pixel",
            .unit = "m",
            .min = 0.001,
            .max = 1,
            .origin = Origin::kGuessed});
  DescribeStart(f, start);
  f.Section("placement", placement, {.meaning = "first placement of the rest pose"});
  if (f.Applies(start == Start::kSearch)) {
    f.Section("start_search", start_search, {.meaning = "search for the first pose"});
  }
  f.Section("recovery", recovery, {.meaning = "detection of a lost subject and relocalisation"});
  DescribeLostBelow(f, lost_below);
  f.Integer("threads", threads,
            {.meaning = "number of threads; the result is the same for any",
             .min = 1,
             .max = 256,
             .origin = Origin::kGuessed,
             .source = "one core, as the papers' times"});
}

}  // namespace vitruvia::articulated
