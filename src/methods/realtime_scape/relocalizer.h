// Finds a lost subject again: searches other poses and places for one frame.
#pragma once

#include <optional>

#include "methods/realtime_scape/pose_fitter.h"
#include "tracking/pose_memory.h"

namespace vitruvia::realtime_scape {

class Relocalizer {
 public:
  // `model` must outlive the relocaliser. It has its own fitter with its own buffers and clock, so
  // a search does not affect what the tracker reports of the frame.
  Relocalizer(const Model& model, const PinholeCamera& camera, const Settings& settings);

  void Remember(const BodyPose& pose) { memory_.Remember(pose); }

  // Hypotheses are the remembered poses and the current one, each with all HypothesisRotations(),
  // aligned with the cloud or one of its parts, and displaced to the sides. The best ones are
  // refined; the best of these is returned if it agrees with the frame clearly better than the
  // current pose. Its agreement and counts are those of the returned pose.
  std::optional<FitSummary> Search(const Observation& observation, const FitSummary& current);
  // The best of the same hypotheses at those parts of the cloud that lie farther than `away_m` from
  // the visible surface of the current pose. Nothing if there is no such part.
  std::optional<FitSummary> SearchElsewhere(const Observation& observation,
                                            const FitSummary& current, double away_m);

 private:
  class Tester;

  std::vector<Vector3d> Centers(const PointCloud& cloud) const;
  BodyPose AlignCentroid(const Vector3d& center, BodyPose pose);
  std::vector<BodyPose> Hypotheses(const std::vector<Vector3d>& centers, const BodyPose& current);

  Settings settings_;
  PinholeCamera camera_;
  PoseFitter fitter_;
  PoseMemory<BodyPose> memory_;
};

}  // namespace vitruvia::realtime_scape
