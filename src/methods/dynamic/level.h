// One level of detail: a surface, the points that it is held against, and what follows from the
// two.
#pragma once

#include "core/timer.h"
#include "core/worker_team.h"
#include "methods/dynamic/association.h"
#include "methods/dynamic/pose_equations.h"
#include "methods/dynamic/tracked_mesh.h"

namespace vitruvia::dynamic {

// The steps of a frame that are timed.
enum TimedStep {
  kCloud,
  kSkin,
  kAssociate,
  kAssemble,
  kSolve,
  kShape,
  kNormals,
  kResult,
  kStepCount
};
inline constexpr std::array<const char*, kStepCount> kStepNames = {
    "cloud", "skin", "associate", "assemble", "solve", "shape", "normals", "result"};

struct StepTimes {
  std::array<double, kStepCount> ms{};
  Stopwatch watch;

  void Lap(TimedStep step) { ms[step] += watch.LapMs(); }
};

struct Level {
  Level(const TrackedMesh& mesh, const PinholeCamera& camera);

  // Poses the surface and lets every point of the cloud choose its vertex.
  void Match(const TreePose& pose, const AssociationLimits& limits, WorkerTeam& team,
             StepTimes& times);
  // The pose's normal equations of what was matched.
  void Assemble(const KinematicTree& tree, const TreePose& pose, WorkerTeam& team,
                PoseEquations& result, StepTimes& times);
  // Share of the points that found a vertex in the last Match.
  double MatchedShare() const;

  Surface<float> surface;
  PointCloud cloud;
  Association association;
  Observations<float> observations;
  LinkEquations<float> equations;
  BoneMotions<float> motions;
};

}  // namespace vitruvia::dynamic
