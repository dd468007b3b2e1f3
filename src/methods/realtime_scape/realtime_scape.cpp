#include "methods/realtime_scape/realtime_scape.h"

#include "core/error.h"
#include "methods/realtime_scape/placement.h"
#include "methods/realtime_scape/prediction.h"
#include "methods/realtime_scape/session.h"

namespace vitruvia::realtime_scape {

RealtimeScape::RealtimeScape(const Settings& settings) : settings_(settings) {}

RealtimeScape::~RealtimeScape() = default;

void RealtimeScape::Start(const Subject& subject, const PinholeCamera& camera) {
  const std::string problem =
      WeightsProblem(subject.weights, subject.rest.vertices.size(), kBoneCount);
  Require(problem.empty(), "Realtime SCAPE cannot use subject {}: {}", subject.name, problem);
  session_ = std::make_unique<Session>(subject, camera, settings_);
}

TrackResult RealtimeScape::TrackFrame(const DepthFrame& frame) {
  Require(session_ != nullptr, "TrackFrame called before Start");
  const bool first = !session_->placed;
  if (!BeginFrame(frame)) {
    session_->recovery.NoteEmptyFrame();
    return Result(false, 0);
  }

  const int limit =
      first ? settings_.stopping.first_frame_iterations : settings_.stopping.max_iterations;
  const bool stopped_small = Iterate(frame, limit);
  const int iterations = session_->iteration;
  if (session_->recovery.Note(CurrentAgreement(), session_->course.pose)) TryOtherPoses(frame);
  EndFrame();
  return Result(stopped_small, iterations);
}

// Lines 1 and 2: the pose to start from; the points P. False if there are none.
bool RealtimeScape::BeginFrame(const DepthFrame& frame) {
  Session& s = *session_;
  Require(frame.depth.width() == s.camera.width && frame.depth.height() == s.camera.height,
          "frame {} is {}×{} pixels, the camera {}×{}", frame.index, frame.depth.width(),
          frame.depth.height(), s.camera.width, s.camera.height);
  s.step_ms.fill(0.0);
  s.energies.fill(0.0);
  s.energy_rise = settings_.solver.watch_energy ? 0.0 : -1.0;
  s.solved = true;
  s.watch.LapMs();
  CloudFromDepth(frame.depth, s.camera, settings_.cloud.stride,
                 static_cast<float>(settings_.cloud.max_depth_m), s.cloud);
  if (s.cloud.points.empty()) return false;
  s.near_cloud->Build(s.cloud.points);
  if (!s.placed) Place();
  Predict();
  s.Lap(kCloudTree);
  return true;
}

void RealtimeScape::Place() {
  Session& s = *session_;
  const Rigidd camera_from_subject =
      PlaceRestPose(s.model, s.cloud, s.camera, settings_.fit, settings_.placement, *s.rasterizer);
  BodyPose pose;
  for (int j = 0; j < kBoneCount; ++j) {
    pose[j] = {camera_from_subject.rotation, camera_from_subject * s.model.rest_centers[j]};
  }
  StartFrom(pose);
  s.placed = true;
}

void RealtimeScape::Predict() {
  Session& s = *session_;
  const Prediction prediction = PredictPose(s.model, s.course.last_pose, s.course.before_last_pose,
                                            s.course.sight, settings_.motion);
  s.course.pose = prediction.pose;
  s.expected = prediction.local_rotations;
  PoseSurface(s.model, s.course.pose, s.surface);
}

void RealtimeScape::EndFrame() {
  Session& s = *session_;
  s.course.sight.EndFrame(settings_.search.seen_share);
  s.course.before_last_pose = s.course.last_pose;
  s.course.last_pose = s.course.pose;
}

TrackResult RealtimeScape::Result(bool stopped_small, int iterations) {
  Session& s = *session_;
  TrackResult result;
  const double presence = CurrentAgreement().presence();
  if (s.cloud.points.empty()) {
    result.outcome = Outcome::kNoData;
    result.message = "the frame holds no measurement; the pose is carried over";
  } else if (presence < settings_.lost_below || s.recovery.is_lost()) {
    result.outcome = Outcome::kLost;
    result.message = fmt::format("the frame confirms {:.0f} % of the model, usually {:.0f} %",
                                 100.0 * presence, 100.0 * s.recovery.usual().presence());
  } else if (!s.solved) {
    result.outcome = Outcome::kLost;
    result.message = "the step has no solution or tears the body apart; the pose is carried over";
  } else {
    result.outcome = stopped_small ? Outcome::kConverged : Outcome::kIterationLimit;
    if (!stopped_small)
      result.message = fmt::format("still moving after {} iterations", iterations);
  }
  result.vertices = s.surface.vertices;
  result.camera_from_rest = s.surface.camera_from_rest;
  if (!s.placed) {  // nothing was ever seen: the rest pose at the origin
    result.vertices = s.model.rest_vertices;
    result.camera_from_rest.assign(kBoneCount, Rigidd{});
  }
  result.joints = PosedJoints(s.model.skeleton, result.camera_from_rest);
  result.iterations = iterations;
  for (std::size_t k = 0; k < kEnergyNames.size(); ++k)
    result.energies.push_back({kEnergyNames[k], s.energies[k]});
  for (std::size_t k = 0; k < kStepCount; ++k)
    result.step_ms.push_back({kStepNames[k], s.step_ms[k]});
  result.energy_rise = s.energy_rise;
  result.condition = iterations > 0 ? s.solver->EstimateCondition() : -1.0;
  return result;
}

}  // namespace vitruvia::realtime_scape
