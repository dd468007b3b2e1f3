// Settings of scan fusion: the fusion of a moving camera's depth frames to one surface.
//
// After KinectFusion (Newcombe et al., ISMAR 2011), called KF below.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/settings.h"

namespace vitruvia {

struct VolumeSettings {
  double voxel_m = 0.004;
  double truncation_m = 0.016;
  double max_weight = 1000.0;
  std::array<double, 3> low_m{-1.2, -0.2, -0.8};  // subject frame
  std::array<double, 3> high_m{1.2, 2.4, 0.8};
  double min_cosine = 0.2;
  double depth_jump_m = 0.04;

  void Describe(Fields& fields);
  std::string Problem() const;
};

struct SmoothingSettings {
  double sigma_px = 1.5;
  double sigma_m = 0.02;

  void Describe(Fields& fields);
};

struct AlignmentSettings {
  std::vector<int> iterations{6, 4, 4};  // one for each level of the pyramid, finest first
  double max_distance_m = 0.05;
  double max_angle_deg = 30.0;
  double stop_rotation_deg = 0.002;
  double stop_translation_m = 2e-5;

  void Describe(Fields& fields);
  std::string Problem() const;
};

// Conditions under which the camera counts as lost.
struct LossSettings {
  double min_matched_share = 0.4;
  double max_rms_m = 0.015;
  double max_condition = 2e4;
  double max_step_m = 0.1;
  double max_step_deg = 5.0;

  void Describe(Fields& fields);
};

struct SurfaceSettings {
  double min_weight = 2.0;
  double island_share = 0.02;

  void Describe(Fields& fields);
};

struct ScanFusionSettings {
  VolumeSettings volume;
  SmoothingSettings smoothing;
  AlignmentSettings alignment;
  LossSettings loss;
  SurfaceSettings surface;
  int stride = 1;
  int threads = 2;

  void Describe(Fields& fields);
};

}  // namespace vitruvia
