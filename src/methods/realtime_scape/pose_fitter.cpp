#include "methods/realtime_scape/pose_fitter.h"

#include <algorithm>
#include <cmath>

#include "math/angles.h"
#include "math/rotation.h"
#include "tracking/visibility.h"

namespace vitruvia::realtime_scape {

using Step = RealtimeScapeStep;

PoseFitter::PoseFitter(const Model& model, const PinholeCamera& camera, const Settings& settings)
    : model_(model),
      camera_(camera),
      settings_(settings),
      joint_term_(model, settings.joint_rows),
      rasterizer_(MakeRasterizer(settings.fit.rasterizer, camera)),
      pixel_sharing_(camera),
      correspondence_finder_(model, camera, settings),
      solver_(MakeLinearSolver(settings.solver.linear)),
      equations_(kBoneCount),
      equations_after_(kBoneCount) {}

FitSummary PoseFitter::Fit(const Observation& observation, const PoseHistory& history,
                           const Prediction& prediction, int max_iterations) {
  FitSummary fit;
  fit.pose = prediction.pose;
  fit.energy_rise = settings_.solver.watch_energy ? 0.0 : -1.0;
  clock_.Restart();
  Pose(fit.pose);
  for (; fit.iterations < max_iterations && !fit.converged && fit.solved; ++fit.iterations) {
    const bool is_view_new = fit.iterations < settings_.fit.visibility_iterations;
    const RenderedView& view = is_view_new ? Render(surface_) : view_;
    const Classification& classification = Classify(observation, surface_, view);
    if (is_view_new) AverageDepth(observation, surface_, view);
    SharePixels(surface_);
    const std::vector<Pair>& pairs =
        Correspond(observation, surface_, view, classification, history.visibility);
    const FreeSpace& free_space = Delimit(observation, surface_, classification);
    const auto input_at = [&](const BodyPose& pose) {
      return TermInput{model_,
                       camera_,
                       settings_,
                       joint_term_,
                       pose,
                       prediction.local_rotations,
                       classification.classes,
                       pairs,
                       free_space};
    };
    fit.energies = Assemble(input_at(fit.pose));
    const Solution solution = Solve(equations_);
    const PoseStep step = ApplyIncrement(fit.pose, solution.increment, settings_.length_unit_m,
                                         settings_.rotation_update);
    fit.solved = solution.status != SolveStatus::kNotPositiveDefinite && !HasDiverged(step.pose);
    fit.pose = fit.solved ? step.pose : history.last;
    fit.inexact_steps += solution.status == SolveStatus::kInexact ? 1 : 0;
    fit.converged = fit.solved && (IsSmall(step) || IsWorthless(solution.increment));
    Pose(fit.pose);
    if (settings_.solver.watch_energy && fit.solved)
      fit.energy_rise = std::max(fit.energy_rise, EnergyRise(equations_, input_at(fit.pose)));
  }
  fit.surface = surface_;
  fit.agreement =
      MeasureAgreement(observation.cloud.points.size(), classification_.unexplained.size(),
                       view_.visible.size(), classification_.classes);
  fit.counts = classification_.counts;
  if (std::isfinite(equations_.energy())) fit.condition = solver_->EstimateCondition();
  if (settings_.solver.watch_energy && fit.solved) {
    fit.check = CheckSolution(equations_.hessian(), -equations_.gradient(), increment_);
    clock_.Skip();  // no step of the algorithm
  }
  if (settings_.uncertainty.IsAsked()) {
    fit.unit_covariances = JointUnitCovariances(fit.pose);
    clock_.Lap(Step::kSolve);
  }
  fit.times = clock_.times();
  return fit;
}

PoseCheck PoseFitter::Compare(const Observation& observation, const BodyPose& pose) {
  const PosedSurface& surface = Pose(pose);
  const RenderedView& view = Render(surface);
  const Classification& classification = Classify(observation, surface, view);
  return {MeasureAgreement(observation.cloud.points.size(), classification.unexplained.size(),
                           view.visible.size(), classification.classes),
          classification.counts};
}

FitSummary PoseFitter::Refine(const Observation& observation, const BodyPose& pose,
                              int max_iterations) {
  FitSummary fit = Fit(observation, AtRest(pose), {pose, LocalRotationsOf(pose)}, max_iterations);
  const PoseCheck reached = Compare(observation, fit.pose);
  fit.agreement = reached.agreement;
  fit.counts = reached.counts;
  return fit;
}

Vector3d PoseFitter::VisibleCentroid(const BodyPose& pose) {
  const PosedSurface& surface = Pose(pose);
  const RenderedView& view = Render(surface);
  if (view.visible.empty()) return pose.front().center;
  Vector3d sum = Vector3d::Zero();
  for (const int v : view.visible) sum += surface.vertices[v].cast<double>();
  return sum / static_cast<double>(view.visible.size());
}

// The end of line 11, before line 5.
const PosedSurface& PoseFitter::Pose(const BodyPose& pose) {
  PoseSurface(model_, pose, surface_);
  clock_.Lap(Step::kUpdate);
  return surface_;
}

// Line 5.
const RenderedView& PoseFitter::Render(const PosedSurface& surface) {
  view_.depth = &rasterizer_->Render(surface.vertices, model_.triangles);
  FindVisibleVertices(surface.vertices, *view_.depth, camera_,
                      static_cast<float>(settings_.fit.visible_within_m), view_.visible);
  clock_.Lap(Step::kRender);
  return view_;
}

// Line 7.
const Classification& PoseFitter::Classify(const Observation& observation,
                                           const PosedSurface& surface, const RenderedView& view) {
  const NearnessSettings nearness = NearnessOf(settings_.fit);
  ClassifyVertices(surface.vertices, view.visible, *observation.depth, camera_, nearness,
                   classification_.classes);
  FindUnexplainedPoints(observation.cloud, *view.depth, nearness, classification_.unexplained);
  classification_.counts = CountByBone(model_, view.visible, classification_.classes);
  clock_.Lap(Step::kClassify);
  return classification_;
}

// Not in the paper, and timed with line 7. `view` must show the surface as it is.
void PoseFitter::AverageDepth(const Observation& observation, const PosedSurface& surface,
                              const RenderedView& view) {
  if (settings_.fit.average_px == 0) return;
  AverageObservedDepth(surface.vertices, *observation.depth, *view.depth, camera_,
                       settings_.fit.average_px, NearnessOf(settings_.fit).depth_m,
                       classification_.classes);
  clock_.Lap(Step::kClassify);
}

// Not in the paper, and timed with line 7.
void PoseFitter::SharePixels(const PosedSurface& surface) {
  if (settings_.fit.pixel_sharing == 0.0) return;
  pixel_sharing_.Weigh(surface.vertices, static_cast<float>(settings_.fit.pixel_sharing),
                       classification_.classes);
  clock_.Lap(Step::kClassify);
}

// Lines 6 and 8.
const std::vector<Pair>& PoseFitter::Correspond(const Observation& observation,
                                                const PosedSurface& surface,
                                                const RenderedView& view,
                                                const Classification& classification,
                                                const BoneVisibility& visibility) {
  const CorrespondenceFinder::SearchSets& sets = correspondence_finder_.BuildSearchSets(
      observation, surface, view, classification, visibility);
  clock_.Lap(Step::kModelTree);
  const std::vector<Pair>& pairs =
      correspondence_finder_.FindPairs(observation, surface, classification, sets, visibility);
  clock_.Lap(Step::kCorrespond);
  return pairs;
}

// Not in the paper, and timed with line 8.
const FreeSpace& PoseFitter::Delimit(const Observation& observation, const PosedSurface& surface,
                                     const Classification& classification) {
  if (settings_.weights[EnergyTerm::kFreeSpace] == 0.0) return free_space_;
  FindFreeSpace(surface.vertices, classification.classes, *observation.depth, camera_,
                settings_.fit, free_space_);
  clock_.Lap(Step::kCorrespond);
  return free_space_;
}

// Line 9.
Energies PoseFitter::Assemble(const TermInput& input) {
  equations_.Reset();
  const Energies energies = AddEnergyTerms(input, equations_);
  equations_.AddDamping(settings_.solver.damping);
  equations_.Symmetrize();
  clock_.Lap(Step::kAssemble);
  return energies;
}

// Line 10.
PoseFitter::Solution PoseFitter::Solve(const BlockNormalEquations& equations) {
  SolveStatus status = SolveStatus::kNotPositiveDefinite;
  if (std::isfinite(equations.energy())) {
    descent_ = -equations.gradient();
    status = solver_->Solve(equations.hessian(), descent_, increment_);
  } else {
    increment_.setZero(equations.size());
  }
  clock_.Lap(Step::kSolve);
  return {increment_, status};
}

// Relative increase of the energy in a step, at fixed correspondences.
double PoseFitter::EnergyRise(const BlockNormalEquations& before, const TermInput& after) {
  equations_after_.Reset();
  AddEnergyTerms(after, equations_after_);
  clock_.Skip();  // no step of the algorithm
  return before.energy() > 0.0 ? equations_after_.energy() / before.energy() - 1.0 : 0.0;
}

// Rows are in units of length_unit_m; a joint moves only with its own bone.
std::vector<Matrix3<double>> PoseFitter::JointUnitCovariances(const BodyPose& pose) const {
  if (!std::isfinite(equations_.energy())) return {};
  const std::vector<Vector3d> joints = PosedJoints(model_.skeleton, ToTransforms(model_, pose));
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(3 * kBoneCount, kBlockSize * kBoneCount);
  for (int bone = 0; bone < kBoneCount; ++bone) {
    auto block = motions.block<3, kBlockSize>(3 * bone, kBlockSize * bone);
    block.leftCols<3>() = -Skew<double>(joints[bone] - pose[bone].center) / settings_.length_unit_m;
    block.rightCols<3>().setIdentity();
  }
  return UnitCovariances(equations_.hessian(), motions);
}

// Line 12.
bool PoseFitter::IsSmall(const PoseStep& step) const {
  return step.largest_rotation_rad < settings_.stopping.rotation_step_deg * kRadiansPerDegree &&
         step.largest_translation_m < settings_.stopping.translation_step_m;
}

// The energy is quadratic where it was linearised: the step that solves H x = −g lowers it by −gᵀx.
bool PoseFitter::IsWorthless(const Eigen::VectorXd& increment) const {
  const double decrease = -equations_.gradient().dot(increment);
  return decrease < settings_.stopping.energy_decrease * equations_.energy();
}

}  // namespace vitruvia::realtime_scape
