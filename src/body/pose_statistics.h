// Statistics of the bones' rotations relative to their parents in captured motion.
#pragma once

#include <array>

#include "body/skeleton.h"

namespace vitruvia {

// A Gaussian over local rotations: mean exp(d), with the components of d independent.
struct LocalRotationStatistics {
  Matrix3<double> mean;           // parent_from_bone
  Vector3<double> deviation_rad;  // of the components of d, in the axes of the mean
};

// In the order of BoneId, the same for both sides of the body. Learnt from four captured clips of
// CMU's database (01_01, 02_01, 02_05, 131_01: jumps, a walk, punches, a dancer's walk), frame by
// frame at 30 frames/s. The pelvis has no statistics: its mean is the identity and its deviations
// are infinite.
const std::array<LocalRotationStatistics, kBoneCount>& CapturedPoseStatistics();

}  // namespace vitruvia
