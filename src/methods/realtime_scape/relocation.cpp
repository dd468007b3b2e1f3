// Looking for a lost subject in other poses and places.
#include <algorithm>
#include <numeric>

#include "methods/realtime_scape/session.h"

namespace vitruvia::realtime_scape {

struct RealtimeScape::TriedPose {
  BodyPose pose;
  Agreement agreement;

  static bool IsBetter(const TriedPose& a, const TriedPose& b) {
    return a.agreement.score() > b.agreement.score();
  }
};

Agreement RealtimeScape::CurrentAgreement() const {
  const Session& s = *session_;
  return MeasureAgreement(s.cloud.points.size(), s.unexplained.size(), s.visible.size(),
                          s.fit.classes);
}

// Puts the body into that pose, as if it had always been in it.
void RealtimeScape::StartFrom(const BodyPose& pose) {
  Session& s = *session_;
  s.course.pose = s.course.last_pose = s.course.before_last_pose = pose;
  s.expected = LocalRotationsOf(pose);
  s.solved = true;
  s.course.sight.Forget();
  PoseSurface(s.model, s.course.pose, s.surface);
}

Agreement RealtimeScape::Compare(const DepthFrame& frame, const BodyPose& pose) {
  StartFrom(pose);
  session_->iteration = 0;
  Render();
  Classify(frame);
  return CurrentAgreement();
}

// The pose moved so that what the camera sees of it lies on the cloud.
BodyPose RealtimeScape::OnCloud(BodyPose pose) {
  constexpr int kRounds = 2;  // what is visible changes as it moves
  Session& s = *session_;
  const auto add = [](const Vector3d& sum, const Vector3f& p) -> Vector3d {
    return sum + p.cast<double>();
  };
  const auto points = static_cast<double>(s.cloud.points.size());
  const Vector3d observed = std::accumulate(s.cloud.points.begin(), s.cloud.points.end(),
                                            Vector3d(Vector3d::Zero()), add) /
                            points;
  for (int round = 0; round < kRounds; ++round) {
    StartFrom(pose);
    s.iteration = 0;
    Render();
    Vector3d seen = Vector3d::Zero();
    for (const int v : s.visible) seen = add(seen, s.surface.vertices[v]);
    const bool nothing = s.visible.empty();
    seen = nothing ? pose.front().center : Vector3d(seen / static_cast<double>(s.visible.size()));
    pose = Shifted(pose, observed - seen);
  }
  return pose;
}

// The poses to try, each where it lies on the cloud and beside that, the best of them first.
std::vector<RealtimeScape::TriedPose> RealtimeScape::BestHypotheses(const DepthFrame& frame,
                                                                    const BodyPose& latest) {
  std::vector<TriedPose> tried;
  for (const BodyPose& hypothesis : session_->recovery.Hypotheses(latest)) {
    const BodyPose pose = OnCloud(hypothesis);
    for (const double aside_m : {0.0, -0.3, 0.3}) {  // part of the body may be out of the image
      const BodyPose there = Shifted(pose, {aside_m, 0.0, 0.0});
      tried.push_back({there, Compare(frame, there)});
    }
  }
  std::stable_sort(tried.begin(), tried.end(), TriedPose::IsBetter);
  tried.resize(std::min(tried.size(), static_cast<std::size_t>(settings_.recovery.tried)));
  return tried;
}

// The best few of many poses get iterations; the best of those is kept if it agrees clearly better.
void RealtimeScape::TryOtherPoses(const DepthFrame& frame) {
  Session& s = *session_;
  const Course course = s.course;
  const Agreement agreement = CurrentAgreement();
  std::vector<TriedPose> tried = BestHypotheses(frame, course.pose);
  for (TriedPose& candidate : tried) {
    StartFrom(candidate.pose);
    Iterate(frame, settings_.stopping.first_frame_iterations);
    const BodyPose reached = s.course.pose;
    candidate = {reached, Compare(frame, reached)};
  }
  const TriedPose& best = *std::min_element(tried.begin(), tried.end(), TriedPose::IsBetter);
  const bool is_better = s.recovery.IsBetter(best.agreement, agreement);
  Compare(frame, is_better ? best.pose : course.pose);
  if (is_better) {
    s.recovery.Found(best.agreement);
  } else {
    s.course = course;
  }
  s.Lap(kRecover);
}

}  // namespace vitruvia::realtime_scape
