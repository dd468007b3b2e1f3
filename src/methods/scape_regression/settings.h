// Settings of SCAPE by regression, fitted to depth and contour (Weiss, Hirshberg & Black 2011).
#pragma once

#include <filesystem>
#include <string>

#include "config/settings.h"
#include "geometry/mesh_rasterizer.h"
#include "tracking/placement.h"
#include "tracking/start_search.h"

namespace vitruvia::scape_regression {

struct DepthTermSettings {
  double facing_cosine = 0.2;
  double weight = 1.0;
  void Describe(Fields& fields);
};

struct ContourTermSettings {
  double weight = 1.0;
  double cutoff_m = 0.15;
  int stride = 1;
  int margin_px = 2;
  void Describe(Fields& fields);
};

struct FitSettings {
  int iterations = 15;
  int first_frame_iterations = 40;
  double first_kernel_m = 0.05, last_kernel_m = 0.02;
  double pose_change_weight = 0.05;
  double pose_weight = 0.02;
  double prediction = 0.8;
  double stop_rad = 1e-3;
  void Describe(Fields& fields);
  std::string Problem() const;
};

struct Settings {
  std::filesystem::path regression;
  DepthTermSettings depth;
  ContourTermSettings contour;
  FitSettings fit;
  double visible_within_m = 0.002;
  Start start = Start::kRestPose;
  PlacementSettings placement;      // of start kRestPose
  PoseSearchSettings start_search;  // of start kSearch
  double max_depth_m = 8.0;
  double lost_below = 0.3;
  void Describe(Fields& fields);
};

}  // namespace vitruvia::scape_regression
