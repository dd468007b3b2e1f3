// Finds a lost subject again: searches other poses and places for one frame.
#pragma once

#include <optional>

#include "methods/realtime_scape/pose_fitter.h"
#include "tracking/pose_memory.h"

namespace vitruvia::realtime_scape {

class Relocalizer {
 public:
  // `model` must outlive the relocaliser. It has a fitter, and with it buffers and a clock, of its
  // own: a search changes nothing that the tracker reports of the frame.
  Relocalizer(const Model& model, const PinholeCamera& camera, const Settings& settings);

  void Remember(const BodyPose& pose) { memory_.Remember(pose); }

  // Hypotheses are the remembered poses and the current one, each rotated to all sides, aligned
  // with the cloud or one of its parts, and beside that place. The best are refined; the best of
  // those is returned if it agrees with the frame clearly better than the current pose. Its
  // agreement and counts are of the pose returned.
  std::optional<FitSummary> Search(const Observation& observation, const FitSummary& current);
  // The best of the same hypotheses at those parts of the cloud that lie farther than `away_m` from
  // what is visible of the current pose. Nothing if there is no such part.
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
