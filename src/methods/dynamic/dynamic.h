// Dynamic (paper B): a skeleton of dual-quaternion joints and a warp for every vertex, fitted to
// each depth frame in turn.
//
// Departures: a frame begins where the joints would be if they went on as they did; the cutoff of
// the association falls over its pose iterations; a frame that is lost changes nothing.
#pragma once

#include <memory>

#include "methods/dynamic/settings.h"
#include "methods/dynamic/skeleton_file.h"
#include "tracking/tracker.h"

namespace vitruvia::dynamic {

class Dynamic final : public Tracker {
 public:
  // Reads the skeleton file. ConfigError naming what is wrong with it.
  explicit Dynamic(const Settings& settings);
  Dynamic(const Settings& settings, SkeletonFile skeleton);  // settings.skeleton is not read
  ~Dynamic() override;

  void Start(const Subject& subject, const PinholeCamera& camera) override;
  TrackResult TrackFrame(const DepthFrame& frame) override;

 private:
  // Everything that depends on the subject and the camera.
  struct Session;

  void BeginFrame(const DepthFrame& frame);
  void Place();
  void Predict();
  void FitPose(bool first);
  bool IsLost() const;  // after FitPose
  void FitShape(bool first);
  TrackResult Result() const;

  Settings settings_;
  SkeletonFile skeleton_;
  std::unique_ptr<Session> session_;
};

}  // namespace vitruvia::dynamic
