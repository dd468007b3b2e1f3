// One level of detail: a surface, the observed points that it is matched with, and the resulting
// equations.
#pragma once

#include <array>

#include "core/worker_team.h"
#include "methods/dynamic/association.h"
#include "methods/dynamic/pose_equations.h"
#include "methods/dynamic/tracked_mesh.h"
#include "tracking/step_clock.h"

namespace vitruvia::dynamic {

// The timed steps of a frame.
enum class TimedStep {
  kCloud,
  kSkin,
  kAssociate,
  kAssemble,
  kSolve,
  kShape,
  kNormals,
  kResult,
  kCount
};
constexpr const char* Name(TimedStep step) {
  constexpr std::array kNames = {"cloud", "skin",  "associate", "assemble",
                                 "solve", "shape", "normals",   "result"};
  static_assert(kNames.size() == static_cast<std::size_t>(TimedStep::kCount));
  return kNames[static_cast<std::size_t>(step)];
}
using Clock = StepClock<TimedStep>;

struct Level {
  Level(const TrackedMesh& mesh, const PinholeCamera& camera);

  // The points of the pixels whose column and row are multiples of the stride.
  void ReadCloud(const DepthImage& depth, const PinholeCamera& camera, int stride_px,
                 double max_depth_m);
  // Eqs. 3 to 5 for all vertices.
  void PoseVertices(const TreePose& pose, WorkerTeam& team, Clock& clock);
  // Poses the surface and associates every point of the cloud with a vertex.
  void Match(const TreePose& pose, const AssociationLimits& limits, WorkerTeam& team, Clock& clock);
  // The pose step's normal equations of the last Match.
  void Assemble(const KinematicTree& tree, const TreePose& pose, WorkerTeam& team,
                PoseEquations& result, Clock& clock);
  // Share of the points that were paired with a vertex in the last Match.
  double MatchedShare() const;

  Surface<float> surface;
  PointCloud cloud;
  Association association;
  Observations<float> observations;
  LinkEquations<float> equations;
};

}  // namespace vitruvia::dynamic
