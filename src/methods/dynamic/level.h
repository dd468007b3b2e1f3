// One level of detail: a surface, the observed points that it is matched with, and the equations
// that follow.
#pragma once

#include "core/timer.h"
#include "core/worker_team.h"
#include "methods/dynamic/association.h"
#include "methods/dynamic/pose_equations.h"
#include "methods/dynamic/tracked_mesh.h"

namespace vitruvia::dynamic {

// The timed steps of a frame.
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

  void Restart() {
    ms.fill(0.0);
    watch.LapMs();
  }
  void Lap(TimedStep step) { ms[step] += watch.LapMs(); }
};

struct Level {
  Level(const TrackedMesh& mesh, const PinholeCamera& camera);

  // Eqs. 3 to 5 for all vertices.
  void PoseVertices(const TreePose& pose, WorkerTeam& team, StepTimes& times);
  // Poses the surface and associates every point of the cloud with a vertex.
  void Match(const TreePose& pose, const AssociationLimits& limits, WorkerTeam& team,
             StepTimes& times);
  // The pose step's normal equations of the last Match.
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
