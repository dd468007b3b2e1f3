// What Realtime SCAPE keeps while it tracks one subject; for the files of RealtimeScape only.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/timer.h"
#include "methods/realtime_scape/bone_sight.h"
#include "methods/realtime_scape/realtime_scape.h"
#include "methods/realtime_scape/terms/fit_term.h"
#include "methods/realtime_scape/terms/inertia_term.h"
#include "methods/realtime_scape/terms/joint_term.h"
#include "solver/linear_solver.h"

namespace vitruvia::realtime_scape {

// The steps of algorithm 1 as table 1 of the paper times them, by line number.
enum TimedStep {
  kCloudTree,
  kRender,
  kVisibleTree,
  kClassify,
  kCorrespond,
  kAssemble,
  kSolve,
  kUpdate,
  kRecover,
  kStepCount
};
inline constexpr std::array<const char*, kStepCount> kStepNames = {
    "2 kd-tree of P", "5 render", "6 kd-tree of V", "7 classify", "8 correspond",
    "9 assemble",     "10 solve", "11 update",      "recover"};

inline constexpr std::array<const char*, 4> kEnergyNames = {"fit", "joint", "inertia", "axis"};

// Where the body is and how it came there.
struct Course {
  BodyPose pose, last_pose, before_last_pose;
  BoneSight sight;
};

// Everything that depends on the subject and the camera.
struct RealtimeScape::Session {
  Session(const Subject& subject, const PinholeCamera& view, const Settings& settings)
      : camera(view),
        model(subject),
        joint_term(model, settings.joint_rows),
        rasterizer(MakeRasterizer(settings.fit.rasterizer, view)),
        course{{}, {}, {}, BoneSight(model)},
        recovery(settings.recovery),
        candidate_finder(model),
        near_cloud(MakeNearestNeighbors(settings.fit.association, view, settings.fit.window_px)),
        near_candidates(
            MakeNearestNeighbors(settings.fit.association, view, settings.fit.window_px)),
        near_settled(MakeNearestNeighbors(settings.fit.association, view, settings.fit.window_px)),
        equations(kBoneCount),
        watched(kBoneCount),
        solver(MakeLinearSolver(settings.solver.linear)) {}

  PinholeCamera camera;
  Model model;
  JointTerm joint_term;
  std::unique_ptr<MeshRasterizer> rasterizer;

  // What is carried from frame to frame.
  bool placed = false;
  Course course;
  Recovery recovery;

  // Workspace, reused from frame to frame.
  int iteration = 0;
  LocalRotations expected;
  PointCloud cloud;
  CandidateFinder candidate_finder;
  std::unique_ptr<NearestNeighbors> near_cloud, near_candidates, near_settled;
  PosedSurface surface;
  const DepthImage* rendered = nullptr;  // the rasteriser's, of the current surface
  std::vector<int> visible, candidates, settled;
  std::vector<int> unexplained;  // P2
  std::vector<int> searching;    // those of P2 that ask for a vertex
  std::vector<Vector3f> positions;
  FitData fit;
  PairFinder pair_finder;
  BlockNormalEquations equations;
  BlockNormalEquations watched;  // of the same correspondences after the step
  double energy_rise = -1.0;     // see TrackResult
  std::unique_ptr<LinearSolver> solver;
  bool solved = true;
  Eigen::VectorXd increment;
  std::array<double, 4> energies{};
  std::array<double, kStepCount> step_ms{};
  Stopwatch watch;

  void Lap(TimedStep step) { step_ms[step] += watch.LapMs(); }
};

}  // namespace vitruvia::realtime_scape
