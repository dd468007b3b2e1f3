// Settings of Realtime SCAPE (paper A, sec. 6).
#pragma once

#include "config/settings.h"
#include "geometry/mesh_rasterizer.h"
#include "methods/realtime_scape/terms/energy_term.h"
#include "search/nearest_neighbors.h"
#include "solver/linear_solver.h"
#include "tracking/area_watch.h"
#include "tracking/classification.h"
#include "tracking/depth_noise.h"
#include "tracking/facing.h"
#include "tracking/frame_checks.h"
#include "tracking/joint_uncertainty.h"
#include "tracking/limb_search.h"
#include "tracking/placement.h"
#include "tracking/relocalization_settings.h"
#include "tracking/start_search.h"

namespace vitruvia::realtime_scape {

// The residual of a visible vertex near the captured surface (V1).
enum class SurfaceResidual {
  kDepth,  // paper: the difference in depth, with the captured depth treated as constant
  kPlane,  // ours: the distance from the captured point along the model's normal, so that the
           // vertex may slide
};

// The residual of a pair of V2 or P2.
enum class PairResidual {
  kPoint,  // paper: the difference in all three coordinates
  kPlane,  // the distance along the vertex's normal, so that the vertex may slide
};

// How the influence of a large residual is reduced.
enum class RobustKernel { kNone, kHuber, kTukey };

// Vertices with which an unexplained point (P2) may be paired.
enum class PairCandidates {
  kVisible,  // paper: the visible ones
  kReach,    // not in the paper: those of bones that are not well explained, including unobserved
             // bones, with a search radius that grows while a bone is unobserved
};

// How a rotation is updated by the solved increment r.
enum class RotationUpdate {
  kLinear,  // paper, literally: R ← (I + r̂) R, which is not a rotation and grows without bound
  kLinearOrthonormal,  // paper, intended reading: the rotation nearest to that
  kExponential,        // ours: R ← exp(r̂) R
};

// The initial pose of a frame, and the reference rotations of the inertia term.
enum class MotionModel {
  kConstantRotation,  // paper: the last frame's pose and local rotations
  kConstantVelocity,  // ours: joints keep their angular velocity
};

// The residuals that hold two neighbouring bones together.
enum class JointRows {
  kJointPosition,  // ours: the joint as the subject's skeleton has it, 3 rows
  kMeanPoint,      // number of rows as in the paper (3 per joint): the vertices' weighted mean on
                   // both bones
  kAllVertices,    // eq. 7 as printed: every shared vertex, exactly, through their moments
};

struct CloudSettings {
  int stride = 2;            // pixels
  double max_depth_m = 8.0;  // metres
  int least_neighbors = 0;   // 0: flying pixels are kept
  double neighbor_within_m = 0.05;
  void Describe(Fields& fields);
};

// Noise model of a residual: a row's weight is 1 / (1 + σ_sensor² / σ_model²).
struct NoiseSettings {
  DepthNoise sensor;
  double model_deviation_m = 0.005;  // metres
  void Describe(Fields& fields);
};

// Visible vertices in observed free space (terms/free_space_term.h).
struct FreeSpaceSettings {
  int margin_px = 2;
  double reach_m = 0.3;  // metres
  void Describe(Fields& fields);
};

struct FitSettings {
  SurfaceResidual surface_residual = SurfaceResidual::kPlane;
  PairResidual pair_residual = PairResidual::kPoint;
  Rasterizer rasterizer = Rasterizer::kFrontFaces;
  int visibility_iterations = 1000;
  double visible_within_m = 0.002;
  double near_surface_m = 0.05;
  int edge_px = 1;
  BehindSurface behind_surface = BehindSurface::kHidden;
  double smooth_m = 0.02;
  Association association = Association::kExhaustive;
  int window_px = 24;
  double pair_cutoff_m = 0.08;
  double surface_weight = 1.0, pair_weight = 1.0;
  int surface_stride = 1;
  int average_px = 0;
  double pixel_sharing = 0.0;
  RobustKernel kernel = RobustKernel::kHuber;
  double kernel_scale_m = 0.01;
  NoiseSettings noise{};
  FreeSpaceSettings free_space{};
  void Describe(Fields& fields);

 private:
  void DescribeVisibility(Fields& fields);
  void DescribeClasses(Fields& fields);
  void DescribePairs(Fields& fields);
  void DescribeWeights(Fields& fields);
};

NearnessSettings NearnessOf(const FitSettings& settings);

struct SearchSettings {
  PairCandidates candidates = PairCandidates::kReach;
  double seen_share = 0.05;
  double well_explained_share = 0.9;
  double owned_m = 0.04;
  double growth_m = 0.02;  // for each frame
  double reach_m = 0.4;
  void Describe(Fields& fields);
};

struct MotionSettings {
  MotionModel model = MotionModel::kConstantVelocity;
  double velocity_share = 0.8;
  double hidden_decay = 0.8;
  void Describe(Fields& fields);
};

struct StoppingSettings {
  double rotation_step_deg = 1.0;
  double translation_step_m = 0.005;
  double energy_decrease = 0.03;  // share of the energy
  int max_iterations = 7;
  int first_frame_iterations = 30;
  void Describe(Fields& fields);
};

struct SolverSettings {
  LinearSolverOptions linear;
  double damping = 1e-9;  // energy per squared radian or length unit
  bool watch_energy = false;
  void Describe(Fields& fields);
};

struct Settings {
  CloudSettings cloud;
  FitSettings fit;
  SearchSettings search;
  MotionSettings motion;
  JointRows joint_rows = JointRows::kJointPosition;
  TermWeights weights;
  double limit_slack_deg = 15.0;
  double length_unit_m = 0.05;
  RotationUpdate rotation_update = RotationUpdate::kExponential;
  StoppingSettings stopping;
  SolverSettings solver;
  Start start = Start::kRestPose;
  PlacementSettings placement;      // of start kRestPose
  PoseSearchSettings start_search;  // of start kSearch
  LimbSettings limbs;
  FacingSettings facing;
  RelocalizationSettings recovery;
  AreaWatchSettings watch;
  UncertaintySettings uncertainty;
  double lost_below = 0.3;
  int least_points = kLeastPoints;
  void Describe(Fields& fields);

 private:
  void DescribeEnergy(Fields& fields);
};

}  // namespace vitruvia::realtime_scape
