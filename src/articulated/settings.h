// Settings that all trackers of an articulated body have.
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

// The pose that is expected, and how far a frame may leave it.
struct PredictionSettings {
  double velocity_share = 0.5;
  double angle_deviation_deg = 5.0;
  double rotation_deviation_deg = 8.0;
  double position_deviation_m = 0.1;

  void Describe(Fields& fields);
};

// How much the data of a frame weigh against the prediction.
struct DataSettings {
  double deviation_m = 0.01;
  double independent_points = 300.0;
  DepthNoise noise;

  void Describe(Fields& fields);
  // Of a point at that depth from the model, the sensor's noise included.
  double Deviation_m(double depth_m) const;
  // Of one row of `rows` that stand for the whole view, of a point at that depth, per m².
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
