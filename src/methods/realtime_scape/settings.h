// Settings of Realtime SCAPE (paper A, sec. 6).
#pragma once

#include "core/settings.h"

namespace vitruvia::realtime_scape {

// What a visible vertex near the captured surface (V1) is asked to do.
enum class SurfaceResidual {
  kDepth,  // paper: only its depth is constrained, as if the captured depth did not change with the
           // pixel
  kPlane,  // ours: its distance from the captured point along the model's normal, which lets it
           // slide
};

// What holds two neighbouring bones together.
enum class JointRows {
  kJointPosition,  // ours: the joint as the subject's skeleton has it, 3 rows
  kMeanPoint,    // paper's count of rows (3 for a joint): the vertices' weighted mean on both bones
  kAllVertices,  // eq. 7 as printed: every shared vertex, exactly, through their moments
};

struct CloudSettings {
  int stride = 2;            // pixels
  double max_depth_m = 8.0;  // metres
  void Describe(Fields& fields);
};

struct FitSettings {
  SurfaceResidual surface_residual = SurfaceResidual::kPlane;
  double visible_within_m = 0.002;
  double near_surface_m = 0.05;
  int edge_px = 1;
  double smooth_m = 0.02;
  double pair_cutoff_m = 0.08;
  double surface_weight = 1.0, pair_weight = 1.0;
  void Describe(Fields& fields);
};

struct StoppingSettings {
  double rotation_step_deg = 1.0;
  double translation_step_m = 0.005;
  int max_iterations = 7;
  int first_frame_iterations = 30;
  void Describe(Fields& fields);
};

struct SolverSettings {
  double relative_tolerance = 1e-6;
  int max_iterations = 204;  // twice the number of unknowns
  double damping = 1e-9;     // energy per squared radian or metre
  void Describe(Fields& fields);
};

struct PlacementSettings {
  int iterations = 30;
  double trim = 0.2;
  void Describe(Fields& fields);
};

struct Settings {
  CloudSettings cloud;
  FitSettings fit;
  JointRows joint_rows = JointRows::kJointPosition;
  double joint_weight = 10.0;
  double inertia_weight = 5.0;
  double axis_weight = 1.0;
  double length_unit_m = 0.05;
  StoppingSettings stopping;
  SolverSettings solver;
  PlacementSettings placement;
  double lost_below = 0.3;
  void Describe(Fields& fields);
};

}  // namespace vitruvia::realtime_scape
