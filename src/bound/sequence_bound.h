// The Cramér–Rao bound of each single frame of a synthesised sequence.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "bound/pose_information.h"
#include "sequence/sequence.h"

namespace vitruvia {

struct FrameBound {
  std::array<double, kBoneCount> joint_m;  // root of the trace of each joint's smallest covariance
};

// Bounds of a sequence's frames. Needs the true surface and joints, the subject, and the sensor's
// model in the provenance, as `vitruvia synth` writes it; DataError names what is missing.
class SequenceBound {
 public:
  SequenceBound(const SequenceReader& sequence, const PosePrior& prior);

  // Nothing for a frame that was not delivered.
  std::optional<FrameBound> At(int frame) const;

  // "" or why a sequence has no bound.
  static std::string Problem(const SequenceInfo& info);

 private:
  const SequenceReader& sequence_;
  SensorSettings sensor_;
  RotationShares shares_;
  Eigen::MatrixXd prior_;
};

}  // namespace vitruvia
