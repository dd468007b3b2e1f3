#include "methods/realtime_scape/relocalizer.h"

#include "geometry/point_sets.h"
#include "math/angles.h"
#include "tracking/cloud_parts.h"
#include "tracking/loss_detector.h"
#include "tracking/pose_search.h"

namespace vitruvia::realtime_scape {
// Tests hypotheses against one frame (see tracking/pose_search.h).
class Relocalizer::Tester {
 public:
  Tester(PoseFitter& fitter, const Observation& observation, int max_iterations)
      : fitter_(fitter), observation_(observation), max_iterations_(max_iterations) {}

  Agreement Compare(const BodyPose& pose) { return fitter_.Compare(observation_, pose).agreement; }

  FitSummary Refine(const BodyPose& pose) {
    return fitter_.Refine(observation_, pose, max_iterations_);
  }

 private:
  PoseFitter& fitter_;
  const Observation& observation_;
  int max_iterations_;
};

Relocalizer::Relocalizer(const Model& model, const PinholeCamera& camera, const Settings& settings)
    : settings_(settings),
      camera_(camera),
      fitter_(model, camera, settings),
      memory_(settings.recovery.num_remembered,
              settings.recovery.min_pose_distance_deg * kRadiansPerDegree, MeanJointAngle) {}

std::optional<FitSummary> Relocalizer::Search(const Observation& observation,
                                              const FitSummary& current) {
  Tester tester(fitter_, observation, settings_.stopping.first_frame_iterations);
  FitSummary best = FindBestPose(Hypotheses(Centers(observation.cloud), current.pose),
                                 settings_.recovery.num_refined, tester);
  if (!IsClearlyBetter(best.agreement, current.agreement, settings_.recovery.margin)) return {};
  return best;
}

std::optional<FitSummary> Relocalizer::SearchElsewhere(const Observation& observation,
                                                       const FitSummary& current, double away_m) {
  const Vector3d here = fitter_.VisibleCentroid(current.pose);
  std::vector<Vector3d> centers = Centers(observation.cloud);
  centers.erase(centers.begin());  // of the whole cloud
  std::erase_if(centers, [&](const Vector3d& center) { return (center - here).norm() <= away_m; });
  if (centers.empty()) return {};
  Tester tester(fitter_, observation, settings_.stopping.first_frame_iterations);
  return FindBestPose(Hypotheses(centers, current.pose), settings_.recovery.num_refined, tester);
}

// Of the whole cloud, and of its parts where there are several.
std::vector<Vector3d> Relocalizer::Centers(const PointCloud& cloud) const {
  constexpr double kMinShare = 0.1;  // of the cloud's points in a part
  std::vector<Vector3d> centers{Centroid(cloud.points)};
  if (settings_.recovery.part_gap_m == 0.0) return centers;
  const std::vector<Vector3d> parts = CentersOfParts(cloud, camera_.width, settings_.cloud.stride,
                                                     settings_.recovery.part_gap_m, kMinShare);
  if (parts.size() > 1) centers.insert(centers.end(), parts.begin(), parts.end());
  return centers;
}

// Translates the pose so that the centroid of its visible vertices lies at `center`.
BodyPose Relocalizer::AlignCentroid(const Vector3d& center, BodyPose pose) {
  constexpr int kRounds = 2;  // moving the body changes what is visible of it
  for (int round = 0; round < kRounds; ++round) {
    pose = Translated(pose, center - fitter_.VisibleCentroid(pose));
  }
  return pose;
}

std::vector<BodyPose> Relocalizer::Hypotheses(const std::vector<Vector3d>& centers,
                                              const BodyPose& current) {
  constexpr std::array kOffsets_m = {0.0, -0.3, 0.3};  // part of the body may be out of the image
  std::vector<BodyPose> seeds = memory_.poses();
  seeds.push_back(current);
  const std::vector<Matrix3<double>> rotations = HypothesisRotations();
  std::vector<BodyPose> hypotheses;
  for (const Vector3d& center : centers) {
    for (const BodyPose& seed : seeds) {
      for (const Matrix3<double>& rotation : rotations) {
        const BodyPose aligned = AlignCentroid(center, RotatedAboutRoot(seed, rotation));
        for (const double offset_m : kOffsets_m) {
          hypotheses.push_back(Translated(aligned, {offset_m, 0.0, 0.0}));
        }
      }
    }
  }
  return hypotheses;
}

}  // namespace vitruvia::realtime_scape
