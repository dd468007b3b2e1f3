// Settings common to all trackers of an articulated body.
#pragma once

#include "config/settings.h"
#include "tracking/depth_noise.h"
#include "tracking/placement.h"
#include "tracking/relocalization_settings.h"
#include "tracking/start_search.h"

namespace vitruvia::articulated {

struct StoppingSettings {
  int iterations = 10;
  int first_frame_iterations = 40;
  double rotation_step_deg = 0.25;
  double translation_step_m = 0.001;

  void Describe(Fields& fields);
};

// The predicted pose and the standard deviations of the prior about it.
struct PredictionSettings {
  double velocity_share = 0.5;
  double angle_deviation_deg = 5.0;
  double rotation_deviation_deg = 8.0;
  double position_deviation_m = 0.1;

  void Describe(Fields& fields);
};

// The weight of a frame's data relative to the prediction.
struct DataSettings {
  double deviation_m = 0.01;
  double independent_points = 300.0;
  DepthNoise noise;

  void Describe(Fields& fields);
  // Standard deviation of a point at that depth from the model, including the sensor's noise.
  double Deviation_m(double depth_m) const;
  // Weight (1/m²) of the row of a point at that depth, if the whole view has `rows` rows.
  double RowWeight(std::size_t rows, double depth_m) const;
};

struct CommonSettings {
  int stride_px = 2;
  double max_depth_m = 10.0;
  StoppingSettings stopping;
  PredictionSettings prediction;
  DataSettings data;
  int surface_vertices = 1500;
  double near_m = 0.05;
  Start start = Start::kRestPose;
  PlacementSettings placement;
  PoseSearchSettings start_search;
  RelocalizationSettings recovery;
  double lost_below = 0.3;
  int threads = 1;

  void Describe(Fields& fields);
};

}  // namespace vitruvia::articulated
