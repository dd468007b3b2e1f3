#include "methods/dynamic/level.h"

#include <algorithm>

namespace vitruvia::dynamic {
namespace {

constexpr int kPatchesPerRange = 4;

}  // namespace

Level::Level(const TrackedMesh& mesh, const PinholeCamera& camera)
    : surface(mesh.weights, mesh.vertices, mesh.normals),
      association(camera, surface.layout),
      equations(surface.layout) {
  observations.Reset(surface.layout.slot_count());
}

void Level::ReadCloud(const DepthImage& depth, const PinholeCamera& camera, int stride_px,
                      double max_depth_m) {
  CloudFromDepth(depth, camera, stride_px, static_cast<float>(max_depth_m), cloud);
  association.SetCloud(cloud);
}

void Level::PoseVertices(const TreePose& pose, WorkerTeam& team, Clock& clock) {
  const BoneMotions<float> motions = MotionsOf<float>(pose);
  const auto& patches = surface.layout.patches;
  team.For(static_cast<int>(patches.size()), kPatchesPerRange, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) PosePatch(patches[i], motions, surface);
  });
  clock.Lap(TimedStep::kSkin);
}

void Level::Match(const TreePose& pose, const AssociationLimits& limits, WorkerTeam& team,
                  Clock& clock) {
  const BoneMotions<float> motions = MotionsOf<float>(pose);
  const auto& patches = surface.layout.patches;
  team.For(static_cast<int>(patches.size()), kPatchesPerRange, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      PosePatch(patches[i], motions, surface);
      association.ProjectPatch(i, surface, limits);
    }
  });
  clock.Lap(TimedStep::kSkin);
  association.FindNearest(limits, team);
  association.Observe(team, observations);
  clock.Lap(TimedStep::kAssociate);
}

void Level::Assemble(const KinematicTree& tree, const TreePose& pose, WorkerTeam& team,
                     PoseEquations& result, Clock& clock) {
  const LinkMotions<float> motions = LinkMotionsOf<float>(pose);
  team.For(static_cast<int>(surface.layout.patches.size()), kPatchesPerRange,
           [&](int begin, int end) {
             for (int i = begin; i < end; ++i) {
               equations.AddPatch(i, surface, motions, observations);
             }
           });
  equations.ReduceToJoints(surface.layout, tree, pose, result);
  clock.Lap(TimedStep::kAssemble);
}

double Level::MatchedShare() const {
  const auto nearest = association.nearest();
  if (nearest.empty()) return 0.0;
  const auto missed = std::count(nearest.begin(), nearest.end(), -1);
  return 1.0 - static_cast<double>(missed) / static_cast<double>(nearest.size());
}

}  // namespace vitruvia::dynamic
