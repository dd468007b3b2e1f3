#include "fitting/pose_search.h"

#include <algorithm>
#include <limits>

#include "body/start_poses.h"
#include "core/error.h"
#include "math/angles.h"
#include "math/rotation.h"

namespace vitruvia {
namespace {

std::vector<FoundPose> Distinct(const ShapedBody& body, const std::vector<FoundPose>& ranked,
                                int most) {
  std::vector<FoundPose> distinct;
  for (const FoundPose& pose : ranked) {
    const bool is_new = std::none_of(distinct.begin(), distinct.end(), [&](const FoundPose& other) {
      return MeanJointDistance(body, pose.state, other.state) < kSamePose_m;
    });
    if (is_new) distinct.push_back(pose);
    if (static_cast<int>(distinct.size()) == most) break;
  }
  return distinct;
}

}  // namespace

std::vector<PoseHypothesis> StartHypotheses(const Matrix3<double>& world_from_front, int headings,
                                            const Eigen::VectorXd& theta) {
  std::vector<PoseHypothesis> hypotheses;
  for (int h = 0; h < headings; ++h) {
    const double heading_deg = 360.0 * h / headings;
    for (const StartPose& start : StartPoses()) {
      BodyState state;
      state.rotation =
          world_from_front * ExpSo3<double>({0.0, heading_deg * kRadiansPerDegree, 0.0});
      state.angles_deg = AnglesOf(start.pose);
      state.theta = theta;
      hypotheses.push_back({state, start.name, heading_deg});
    }
  }
  return hypotheses;
}

double MeanJointDistance(const ShapedBody& body, const BodyState& a, const BodyState& b) {
  const std::vector<Vector3d> at =
      PosedJoints(ShapedSkeleton(body, a.theta), WorldFromRest(body, a));
  const std::vector<Vector3d> bt =
      PosedJoints(ShapedSkeleton(body, b.theta), WorldFromRest(body, b));
  double sum = 0.0;
  for (int j = 0; j < kBoneCount; ++j) sum += (at[j] - bt[j]).norm();
  return sum / kBoneCount;
}

SearchOutcome SearchPose(const std::vector<PoseHypothesis>& hypotheses,
                         const std::vector<SearchLevel>& levels, FitPriors priors,
                         const NearFar& limits) {
  Require(!hypotheses.empty() && !levels.empty(), "SearchPose: {} hypotheses, {} levels",
          hypotheses.size(), levels.size());
  std::vector<FoundPose> poses;
  for (const PoseHypothesis& h : hypotheses) {
    poses.push_back({&h, levels.front().fit->Centered(*levels.front().target, h.state), {}});
  }
  for (const SearchLevel& level : levels) {
    for (FoundPose& pose : poses) {
      priors.angles_deg = pose.state.angles_deg;
      priors.theta = pose.start->state.theta;
      pose.state = level.fit->Run(*level.target, pose.state, level.stage, priors);
      pose.distance = level.fit->Measure(*level.target, pose.state, limits);
    }
    std::stable_sort(poses.begin(), poses.end(), [](const FoundPose& a, const FoundPose& b) {
      return a.distance.mean_m() < b.distance.mean_m();
    });
    poses = Distinct(level.fit->body(), poses, level.kept);
  }
  SearchOutcome outcome{poses.front(), std::numeric_limits<double>::infinity()};
  if (poses.size() > 1) {
    outcome.margin = poses[1].distance.mean_m() / poses[0].distance.mean_m() - 1.0;
  }
  return outcome;
}

}  // namespace vitruvia
