// SCAPE with pose-dependent deformations by regression, fitted to each frame's depth and contour
// (Weiss, Hirshberg & Black, ICCV 2011), with which paper A's figure 8 compares. Offline: about an
// hour per pose in that paper.
//
// As in that figure the intrinsic shape is given: it is the subject's mesh. One view for each pose.
// docs/baseline_models.md separates what the paper states from interpretations.
#pragma once

#include <memory>
#include <optional>

#include "learning/shape/pose_regression.h"
#include "methods/scape_regression/settings.h"
#include "tracking/tracker.h"

namespace vitruvia {
struct PointCloud;
}

namespace vitruvia::scape_regression {

struct FitResult;
struct ScapePose;

class ScapeRegression final : public Tracker {
 public:
  // Reads the pose regression. ConfigError if there is none, DataError if it is damaged.
  explicit ScapeRegression(const Settings& settings);
  ScapeRegression(const Settings& settings, PoseRegression regression);
  ~ScapeRegression() override;

  void Start(const Subject& subject, const PinholeCamera& camera) override;
  // Energies: depth, contour, change of the pose, unusualness of the pose, in mm².
  TrackResult TrackFrame(const DepthFrame& frame) override;

 private:
  struct Session;  // everything that depends on the subject and the camera

  std::optional<ScapePose> FirstPose(const DepthFrame& frame, const PointCloud& cloud);
  void ReportOutcome(const FitResult& fit, TrackResult& result) const;

  Settings settings_;
  PoseRegression regression_;
  std::unique_ptr<Session> session_;
};

}  // namespace vitruvia::scape_regression
