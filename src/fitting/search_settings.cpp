#include "fitting/search_settings.h"

namespace vitruvia {

void PoseSearchSettings::Describe(Fields& f) {
  f.Integer("headings", headings,
            {.meaning = "directions, evenly spaced, in which each start pose of the search faces",
             .min = 1,
             .max = 72,
             .origin = Origin::kGuessed});
  f.Integer("coarse_vertices", coarse_vertices,
            {.meaning = "vertices of the body while start poses are compared",
             .min = 100,
             .max = 100000,
             .origin = Origin::kGuessed});
  f.Integer("fine_vertices", fine_vertices,
            {.meaning = "vertices of the body while the best start poses are refined",
             .min = 100,
             .max = 100000,
             .origin = Origin::kGuessed});
  f.Number("angle_deviation_deg", angle_deviation_deg,
           {.meaning = "standard deviation of a joint angle from its start pose",
            .unit = "deg",
            .min = 1.0,
            .max = 180.0,
            .origin = Origin::kGuessed});
  f.Number("near_m", near_m,
           {.meaning = "distance up to which the body and the measurements explain each other",
            .unit = "m",
            .min = 0.001,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Number(
      "near_growth_per_m", near_growth_per_m,
      {.meaning = "growth of near_m with the square of the distance from the camera, when it is "
                  "judged whether a depth frame shows the person",
       .unit = "1/m",
       .min = 0.0,
       .max = 0.1,
       .origin = Origin::kTuned,
       .source = "a captured man at 3.2 to 4 m under the noise of a Kinect v1: without it he is "
                 "not found in the first 48 frames; the deviation of such a sensor grows by "
                 "0.0019 per m (Nguyen, Izadi & Lovell 2012)"});
  f.Number(
      "far_m", far_m,
      {.meaning = "distance at which distances between the body and the measurements are truncated",
       .unit = "m",
       .min = 0.001,
       .max = 1.0,
       .origin = Origin::kGuessed});
  f.Number("least_explained", least_explained,
           {.meaning = "share of the measurements, and of the evaluable part of the body, that "
                       "must be explained for a person to be found",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
}

}  // namespace vitruvia
