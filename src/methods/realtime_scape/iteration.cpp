// One iteration of algorithm 1 (paper A): lines 5 to 12.
#include <algorithm>
#include <cmath>

#include "math/angles.h"
#include "methods/realtime_scape/pose_step.h"
#include "methods/realtime_scape/session.h"
#include "methods/realtime_scape/terms/axis_term.h"
#include "tracking/visibility.h"

namespace vitruvia::realtime_scape {

// Lines 4 to 12. True if the stopping rule was met.
bool RealtimeScape::Iterate(const DepthFrame& frame, int limit) {
  int& iteration = session_->iteration;
  bool stopped_small = false;
  for (iteration = 0; iteration < limit && !stopped_small && session_->solved; ++iteration) {
    Render();
    Classify(frame);
    BuildCandidates();
    FindPairs();
    Assemble();
    Solve();
    stopped_small = IsSmall(Update());
    if (settings_.solver.watch_energy) WatchEnergy();
  }
  return stopped_small;
}

// Line 5.
void RealtimeScape::Render() {
  Session& s = *session_;
  if (s.iteration < settings_.fit.visibility_iterations) {
    s.rendered = &s.rasterizer->Render(s.surface.vertices, s.model.triangles);
    FindVisibleVertices(s.surface.vertices, *s.rendered, s.camera,
                        static_cast<float>(settings_.fit.visible_within_m), s.visible);
  }
  s.Lap(kRender);
}

// Line 7.
void RealtimeScape::Classify(const DepthFrame& frame) {
  Session& s = *session_;
  const NearnessSettings nearness{static_cast<float>(settings_.fit.near_surface_m),
                                  settings_.fit.edge_px, static_cast<float>(settings_.fit.smooth_m),
                                  settings_.fit.behind_surface};
  ClassifyVertices(s.surface.vertices, s.visible, frame.depth, s.camera, nearness, s.fit.classes);
  FindUnexplainedPoints(s.cloud, *s.rendered, nearness, s.unexplained);
  s.course.sight.Count(s.model, s.visible, s.fit.classes);
  s.Lap(kClassify);
}

// Line 6; after line 7, for what may be paired depends on what is confirmed.
void RealtimeScape::BuildCandidates() {
  Session& s = *session_;
  s.searching = s.unexplained;
  s.candidate_finder.Find(s.model, s.surface, s.visible, s.course.sight, settings_.search,
                          s.candidates, s.settled);
  const auto build = [&](const std::vector<int>& vertices, NearestNeighbors& neighbors) {
    s.positions.clear();
    for (const int i : vertices) s.positions.push_back(s.surface.vertices[i]);
    neighbors.Build(s.positions);
  };
  build(s.candidates, *s.near_candidates);
  if (s.settled.empty()) return s.Lap(kVisibleTree);
  // Points at the skin of settled bones are theirs, and ask nothing.
  build(s.settled, *s.near_settled);
  s.pair_finder.DropNear(s.cloud, *s.near_settled, static_cast<float>(settings_.search.owned_m),
                         s.searching);
  s.Lap(kVisibleTree);
}

// Line 8.
void RealtimeScape::FindPairs() {
  Session& s = *session_;
  std::array<float, kBoneCount> reach;
  for (int j = 0; j < kBoneCount; ++j) {
    reach[j] = static_cast<float>(ReachOf(j, s.course.sight, settings_.fit, settings_.search));
  }
  s.fit.pairs.clear();
  s.pair_finder.VerticesToPoints(s.surface.vertices, s.fit.classes.elsewhere, s.cloud,
                                 *s.near_cloud, static_cast<float>(settings_.fit.pair_cutoff_m),
                                 s.fit.pairs);
  s.pair_finder.PointsToVertices(
      s.cloud, s.searching, s.candidates, *s.near_candidates,
      *std::max_element(reach.begin(), reach.end()),
      [&](int vertex) { return reach[s.model.weights.bones[vertex][0]]; }, s.fit.pairs);
  s.Lap(kCorrespond);
}

// Returns the energy of each term.
std::array<double, 4> RealtimeScape::AddTerms(BlockNormalEquations& equations) const {
  const Session& s = *session_;
  const double unit = settings_.length_unit_m;
  return {AddFitTerm(s.model, s.course.pose, s.camera, s.fit, settings_.fit, unit, equations),
          s.joint_term.Add(s.model, s.course.pose, settings_.joint_weight, unit, equations),
          AddInertiaTerm(s.course.pose, s.expected, settings_.inertia_weight, equations),
          AddAxisTerm(s.course.pose, settings_.axis_weight, equations)};
}

// Line 9.
void RealtimeScape::Assemble() {
  Session& s = *session_;
  s.equations.Reset();
  s.energies = AddTerms(s.equations);
  s.equations.AddDamping(settings_.solver.damping);
  s.equations.Symmetrize();
  s.Lap(kAssemble);
}

// Line 10.
void RealtimeScape::Solve() {
  Session& s = *session_;
  const bool finite = std::isfinite(s.equations.energy());
  s.solved = finite && s.solver->Solve(s.equations.hessian(), -s.equations.gradient(), s.increment);
  if (!finite) s.increment.setZero(s.equations.size());
  s.Lap(kSolve);
}

// Line 11.
RealtimeScape::Step RealtimeScape::Update() {
  Session& s = *session_;
  Step largest;
  for (int j = 0; j < kBoneCount; ++j) {
    const Vector3d rotation = s.increment.segment<3>(kBlockSize * j);
    const Vector3d translation =
        settings_.length_unit_m * s.increment.segment<3>(kBlockSize * j + 3);
    s.course.pose[j].rotation =
        Turned(s.course.pose[j].rotation, rotation, settings_.rotation_update);
    s.course.pose[j].center += translation;
    largest.rotation_rad = std::max(largest.rotation_rad, rotation.norm());
    largest.translation_m = std::max(largest.translation_m, translation.norm());
  }
  if (!s.solved || IsTornApart(s.course.pose)) {
    s.course.pose = s.course.last_pose;
    s.solved = false;
  }
  PoseSurface(s.model, s.course.pose, s.surface);
  s.Lap(kUpdate);
  return largest;
}

// What the step made of the energy that it was to lower.
void RealtimeScape::WatchEnergy() {
  Session& s = *session_;
  if (!s.solved) return;  // the step was not taken
  s.watched.Reset();
  AddTerms(s.watched);
  const double before = s.equations.energy(), after = s.watched.energy();
  if (before > 0.0) s.energy_rise = std::max(s.energy_rise, after / before - 1.0);
  s.watch.LapMs();  // no step of the algorithm
}

// Line 12.
bool RealtimeScape::IsSmall(const Step& step) const {
  return step.rotation_rad < settings_.stopping.rotation_step_deg * kRadiansPerDegree &&
         step.translation_m < settings_.stopping.translation_step_m;
}

}  // namespace vitruvia::realtime_scape
