// A skeleton-driven rig (paper A, figure 9): the subject's mesh with heat-diffusion weights, moved
// by a skeleton that inverse kinematics brings to joints found in each frame.
//
// The joints come from a detector learnt on synthetic depth or from a file. No frame depends on the
// one before; nothing compares the surface with the depth.
#pragma once

#include <memory>

#include "methods/skeleton_driven/settings.h"
#include "tracking/tracker.h"

namespace vitruvia::skeleton_driven {

// Where the joints of a frame come from.
class JointFinder {
 public:
  virtual ~JointFinder() = default;
  // Camera frame, metres; none where the frame shows nothing. `size` is the subject's (SizeOf).
  virtual GivenPoints Find(const DepthFrame& frame, const PinholeCamera& camera,
                           double size) const = 0;
};

class SkeletonDriven final : public Tracker {
 public:
  // Reads the model or the observations. ConfigError or DataError naming what is wrong with them.
  explicit SkeletonDriven(const Settings& settings);
  SkeletonDriven(const Settings& settings, std::unique_ptr<JointFinder> joints);
  ~SkeletonDriven() override;

  void Start(const Subject& subject, const PinholeCamera& camera) override;
  // Energies: of the points, of the pose. Iterations: of the inverse kinematics.
  TrackResult TrackFrame(const DepthFrame& frame) override;

 private:
  struct Session;  // everything that depends on the subject and the camera

  Settings settings_;
  std::unique_ptr<JointFinder> joints_;
  std::unique_ptr<Session> session_;
};

}  // namespace vitruvia::skeleton_driven
