// Settings of Dynamic (paper B, sec. 4).
#pragma once

#include <filesystem>
#include <string>

#include "config/settings.h"
#include "tracking/area_watch.h"
#include "tracking/facing.h"
#include "tracking/frame_checks.h"
#include "tracking/joint_uncertainty.h"
#include "tracking/limb_search.h"
#include "tracking/start_search.h"

namespace vitruvia::dynamic {

// Deformation of the surface by warps (paper B, sec. 5.1).
enum class Mode {
  kFull,        // warps are estimated in every frame
  kShapeMatch,  // warps are estimated in the first frame only, then frozen
  kSmoothBind,  // not at all
  kRigid,       // no warps, and the mesh is cut into one rigid part for each bone
};

struct AssociationSettings {
  int window_px = 32;
  double cutoff_m = 0.12;
  double last_cutoff_m = 0.02;
  double facing_cosine = 0.1;
  int pose_pixel_stride = 1;
  int pose_vertex_stride = 1;
  void Describe(Fields& fields);
  std::string Problem() const;
};

struct PoseSettings {
  int iterations = 10;
  int first_frame_iterations = 30;
  double prediction = 0.8;
  double damping = 0.01;
  double default_pose_weight = 1e-6;
  double freeze_below_share = 0.01;
  double rotation_step_deg = 0.0;
  double translation_step_m = 0.0;
  void Describe(Fields& fields);
};

struct ShapeSettings {
  int iterations = 2;
  int first_frame_iterations = 20;
  double cutoff_m = 0.04;
  double magnitude_weight = 0.01;
  double neighbor_weight = 0.2;
  void Describe(Fields& fields);
};

struct PlacementSettings {
  int iterations = 30;
  int window_px = 64;
  double cutoff_m = 0.5;
  void Describe(Fields& fields);
};

struct Settings {
  std::filesystem::path skeleton;
  Mode mode = Mode::kFull;
  AssociationSettings association;
  PoseSettings pose;
  ShapeSettings shape;
  Start start = Start::kRestPose;
  PlacementSettings placement;      // of start kRestPose
  PoseSearchSettings start_search;  // of start kSearch, and where areas are watched
  AreaWatchSettings watch;
  LimbSettings limbs;
  int area_edge_px = 1;  // where areas are watched or limbs searched
  FacingSettings facing{.margin_m = 0.0};
  UncertaintySettings uncertainty;
  double max_depth_m = 8.0;
  double lost_below = 0.3;
  int least_points = kLeastPoints;
  int threads = 2;
  void Describe(Fields& fields);
};

}  // namespace vitruvia::dynamic
