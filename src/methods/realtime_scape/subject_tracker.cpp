#include "methods/realtime_scape/subject_tracker.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "math/rigid.h"
#include "tracking/placement.h"

namespace vitruvia::realtime_scape {

using Step = RealtimeScapeStep;

namespace {

// The angle between each bone's axis and where its parent would carry it from the rest pose; 0 for
// the root.
std::array<double, kBoneCount> BendsOf(const Skeleton& skeleton, const BodyPose& pose) {
  const LocalRotations local = LocalRotationsOf(pose);
  std::array<double, kBoneCount> bends_rad{};
  for (int bone = 0; bone < kBoneCount; ++bone) {
    if (Bones()[bone].parent < 0) continue;
    const Vector3d axis = (skeleton.tips[bone] - skeleton.joints[bone]).normalized();
    bends_rad[bone] = std::acos(std::clamp(axis.dot(local[bone] * axis), -1.0, 1.0));
  }
  return bends_rad;
}

}  // namespace

SubjectTracker::SubjectTracker(const Subject& subject, const PinholeCamera& camera,
                               const Settings& settings)
    : camera_(camera),
      settings_(settings),
      model_(subject),
      observer_(camera, settings),
      fitter_(model_, camera, settings),
      relocalizer_(model_, camera, settings),
      loss_detector_(settings.recovery) {
  if (settings.facing.margin_m > 0.0) facing_check_.emplace(model_, camera, settings);
  if (settings.limbs.min_unexplained_m2 > 0.0) limb_finder_.emplace(model_, camera, settings);
  if (settings.watch.lost_above > 0.0) watch_.emplace(settings.watch);
  if (watch_ || settings.uncertainty.IsAsked()) {
    area_meter_.emplace(subject, camera, settings.cloud.stride, settings.cloud.max_depth_m,
                        settings.watch.reach_m);
  }
  if (settings.start == Start::kSearch) {
    start_search_.emplace(subject, camera, settings.cloud.max_depth_m, settings.start_search);
  }
}

TrackResult SubjectTracker::TrackFrame(const DepthFrame& frame) {
  CheckFrameSize(frame, camera_);
  clock_.Restart();
  const Observation& observation = observer_.Observe(frame.depth);
  if (std::optional<UnfittedFrame> unfitted = CheckPoints(
          observation.cloud, frame.depth, settings_.cloud.max_depth_m, settings_.least_points)) {
    return CarryOver({unfitted->outcome, std::move(unfitted->message)});
  }
  const bool is_first = !history_;
  if (is_first) history_ = FirstPose(observation, frame.known);
  if (!history_) return CarryOver({Outcome::kLost, start_message_});
  const Prediction prediction = PredictPose(model_, *history_, settings_.motion);
  clock_.Lap(Step::kCloudTree);

  const StoppingSettings& stopping = settings_.stopping;
  FitSummary fit =
      fitter_.Fit(observation, *history_, prediction,
                  is_first ? stopping.first_frame_iterations : stopping.max_iterations);
  clock_.Skip();
  fit = TakeOtherFacing(observation, std::move(fit));
  fit = TakeFoundLimb(observation, std::move(fit));
  fit = TakeBetterPose(observation, std::move(fit), is_first);
  history_ = Advanced(*history_, model_, fit.pose, fit.counts, settings_.search.seen_share);
  fit.times += clock_.times();
  if (settings_.uncertainty.IsAsked()) fit.supports = SupportsOf(observation, fit);
  Ending ending = EndingOf(fit);
  if (is_first && start_search_) ending.message = WithStart(start_message_, ending.message);
  return Result(std::move(fit), std::move(ending));
}

// Nothing if a search does not find the subject.
std::optional<PoseHistory> SubjectTracker::FirstPose(const Observation& observation,
                                                     const KnownJoints& known) {
  if (!start_search_) return Place(observation.cloud);
  const FoundStart start = start_search_->Find(*observation.depth, known);
  start_message_ = start.message;
  clock_.Lap(Step::kRelocalize);
  if (!start.found) return {};
  return AtRest(ToPose(model_, start.camera_from_rest));
}

PoseHistory SubjectTracker::Place(const PointCloud& cloud) const {
  const std::unique_ptr<MeshRasterizer> rasterizer =
      MakeRasterizer(settings_.fit.rasterizer, camera_);
  const Rigidd camera_from_subject =
      PlaceRestPose({model_.rest_vertices, model_.triangles}, cloud, camera_,
                    settings_.fit.visible_within_m, settings_.placement, *rasterizer);
  return AtRest(RestPose(model_, camera_from_subject));
}

// The time of a search is charged to the same step as relocalisation.
FitSummary SubjectTracker::TakeOtherFacing(const Observation& observation, FitSummary fit) {
  if (!facing_check_) return fit;
  std::optional<FitSummary> found =
      facing_check_->Search(observation, fit, fitter_.rendered(), history_->last);
  clock_.Lap(Step::kRelocalize);
  if (!found) return fit;
  history_ = AtRest(found->pose);
  found->times = fit.times;
  return *std::move(found);
}

// As above.
FitSummary SubjectTracker::TakeFoundLimb(const Observation& observation, FitSummary fit) {
  if (!limb_finder_) return fit;
  std::optional<FitSummary> found = limb_finder_->Search(observation, fit, fitter_.unexplained());
  clock_.Lap(Step::kRelocalize);
  if (!found) return fit;
  history_ = AtRest(found->pose);
  found->times = fit.times;
  return *std::move(found);
}

// Searches other poses when agreement has been low for long enough, or when another body may be the
// subject. The result of a search replaces the fit except for its times: the whole search is one
// step of the frame.
FitSummary SubjectTracker::TakeBetterPose(const Observation& observation, FitSummary fit,
                                          bool is_first) {
  const FrameVerdict verdict = loss_detector_.Assess(fit.agreement);
  if (watch_) watch_->Assess(MeasureAreas(observation, fit));
  // If the first fit was to another object, its pose is useless for a search, so the rest pose is
  // remembered.
  if (is_first && watch_) relocalizer_.Remember(history_->last);
  const bool is_doubted = watch_ && watch_->is_lost();
  if (is_first || (verdict == FrameVerdict::kAgrees && !is_doubted))
    relocalizer_.Remember(fit.pose);

  std::optional<FitSummary> found;
  if (watch_ && watch_->is_search_due()) found = FindElsewhere(observation, fit);
  if (!found && verdict == FrameVerdict::kSearch) found = relocalizer_.Search(observation, fit);
  clock_.Lap(Step::kRelocalize);
  if (!found) return fit;
  loss_detector_.NoteFound(found->agreement);
  if (watch_) watch_->NoteFound(MeasureAreas(observation, *found));
  history_ = AtRest(found->pose);
  found->times = fit.times;
  return *std::move(found);
}

// A pose out of the current one's reach, if it overlaps better with the frame.
std::optional<FitSummary> SubjectTracker::FindElsewhere(const Observation& observation,
                                                        const FitSummary& fit) {
  std::optional<FitSummary> found =
      relocalizer_.SearchElsewhere(observation, fit, settings_.watch.reach_m);
  if (!found) return {};
  const double here = MeasureAreas(observation, fit).overlap();
  const double there = MeasureAreas(observation, *found).overlap();
  if (there <= here + settings_.watch.margin) return {};
  return found;
}

BodyAreas SubjectTracker::MeasureAreas(const Observation& observation, const FitSummary& fit) {
  return area_meter_->Measure(fit.surface.vertices, fit.surface.camera_from_rest,
                              *observation.depth, NearnessOf(settings_.fit));
}

std::vector<JointSupport> SubjectTracker::SupportsOf(const Observation& observation,
                                                     const FitSummary& fit) {
  const BodyAreas areas = MeasureAreas(observation, fit);
  const std::array<double, kBoneCount> bends_rad = BendsOf(model_.skeleton, fit.pose);
  std::vector<JointSupport> supports(kBoneCount);
  for (int bone = 0; bone < kBoneCount; ++bone) {
    const int visible = fit.counts.visible[bone], parent = Bones()[bone].parent;
    JointSupport& support = supports[bone];
    support.confirmed =
        visible > 0 ? static_cast<double>(fit.counts.confirmed[bone]) / visible : 0.0;
    support.disagreement = std::max(areas.bones[bone].disagreement(),
                                    parent < 0 ? 0.0 : areas.bones[parent].disagreement());
    support.bend_rad = std::max(bends_rad[bone], parent < 0 ? 0.0 : bends_rad[parent]);
  }
  return supports;
}

// Result of a frame that cannot be fitted: the last pose, or the rest pose at the camera if no
// frame was fitted before.
TrackResult SubjectTracker::CarryOver(Ending ending) {
  loss_detector_.NoteEmptyFrame();
  FitSummary fit;
  if (history_) {
    PoseSurface(model_, history_->last, fit.surface);
  } else {
    fit.surface = {model_.rest_vertices, BoneTransforms(kBoneCount)};
  }
  fit.energy_rise = settings_.solver.watch_energy ? 0.0 : -1.0;
  return Result(std::move(fit), std::move(ending));
}

SubjectTracker::Ending SubjectTracker::EndingOf(const FitSummary& fit) const {
  if (fit.agreement.presence() < settings_.lost_below || loss_detector_.is_lost()) {
    return {Outcome::kLost, loss_detector_.MessageOf(fit.agreement)};
  }
  if (watch_ && watch_->is_lost()) {
    return {Outcome::kLost, watch_->message()};
  }
  if (!fit.solved) {
    return {Outcome::kLost,
            "the normal equations have no solution, or the step diverges; the pose is carried "
            "over"};
  }
  if (fit.converged) return {Outcome::kConverged, ""};
  std::string message = fmt::format("still moving after {} iterations", fit.iterations);
  if (fit.inexact_steps > 0) {
    message += fmt::format("; conjugate gradients missed their tolerance in {} of them",
                           fit.inexact_steps);
  }
  return {Outcome::kIterationLimit, message};
}

TrackResult SubjectTracker::Result(FitSummary fit, Ending ending) const {
  TrackResult result;
  result.outcome = ending.outcome;
  result.message = std::move(ending.message);
  result.vertices = std::move(fit.surface.vertices);
  result.camera_from_rest = std::move(fit.surface.camera_from_rest);
  result.joints = PosedJoints(model_.skeleton, result.camera_from_rest);
  if (settings_.uncertainty.IsAsked())
    ReportUncertainty(fit.unit_covariances, fit.supports, settings_.uncertainty, result);
  result.iterations = fit.iterations;
  result.energies.reserve(kEnergyTermCount);
  for (std::size_t k = 0; k < kEnergyTermCount; ++k) {
    result.energies.push_back({Name(static_cast<EnergyTerm>(k)), fit.energies[k]});
  }
  result.step_ms = fit.times.Named();
  result.energy_rise = fit.energy_rise;
  result.condition = fit.condition;
  if (fit.check) {
    result.weak_directions = fit.check->weak_directions;
    result.agreeing_digits = fit.check->agreeing_digits;
  }
  return result;
}

}  // namespace vitruvia::realtime_scape
