// Dynamic (paper B): a skeleton of dual-quaternion joints and a warp for every vertex, fitted to
// each depth frame in turn.
//
// Departures: a frame starts from a prediction of the joints' motion; the cutoff of the association
// falls over the pose iterations of a frame; a lost frame changes neither pose nor shape.
#pragma once

#include <memory>

#include "methods/dynamic/placement.h"
#include "methods/dynamic/settings.h"
#include "methods/dynamic/skeleton_file.h"
#include "tracking/body_areas.h"
#include "tracking/tracker.h"

namespace vitruvia::dynamic {

class Dynamic final : public Tracker {
 public:
  // Reads the skeleton file. ConfigError if it is invalid.
  explicit Dynamic(const Settings& settings);
  Dynamic(const Settings& settings, SkeletonFile skeleton);  // settings.skeleton is not read
  ~Dynamic() override;

  void Start(const Subject& subject, const PinholeCamera& camera) override;
  // Energies: see energy_terms.h.
  TrackResult TrackFrame(const DepthFrame& frame) override;

 private:
  struct Session;  // everything that depends on the subject and the camera
  struct FrameFit;

  void ReadClouds(const DepthFrame& frame);
  void FindFirstPose(const DepthFrame& frame);
  void Place();
  void WatchAreas(const DepthFrame& frame);
  BodyAreas MeasureAreas(const DepthImage& depth);
  FrameFit FitPose(bool is_first);
  FrameFit TakeOtherFacing(const DepthFrame& frame, FrameFit fit);
  FrameFit TakeFoundLimb(const DepthFrame& frame, FrameFit fit);
  double LimbOverlap(const DepthImage& depth);
  FrameFit Refine(const TreeStart& start, int limit);
  double GapTo(const DepthImage& depth);
  const std::vector<Vector3<float>>& SubjectVertices();
  void IteratePose(int limit, FrameFit& fit);
  bool IsLost(const FrameFit& fit) const;
  void FitShape(bool is_first, FrameFit& fit);
  std::vector<Matrix3<double>> JointUnitCovariances(
      const FrameFit& fit, const std::vector<Vector3<double>>& joints) const;
  TrackResult Result(const FrameFit& fit);
  void ReportOutcome(const FrameFit& fit, TrackResult& result) const;

  Settings settings_;
  SkeletonFile skeleton_;
  std::unique_ptr<Session> session_;
};

}  // namespace vitruvia::dynamic
