// Causes of a joint's position error.
#pragma once

#include <string_view>

namespace vitruvia {

// In the order in which they are tested: the first that applies is the cause.
enum class Cause {
  kSmall,       // the error is small: there is nothing to explain
  kFacing,      // left and right are exchanged in the estimate
  kStart,       // the body has not been found since the first frame
  kOutOfView,   // the joint is outside the image
  kHidden,      // another surface lies between camera and joint
  kNoData,      // the frame holds no measurement
  kFewPairs,    // too few pixels lie on the limb
  kFast,        // the joint has moved far since the frame before
  kNoise,       // the depth is noisy where the limb is
  kLimbOnBody,  // the limb touches another part of the body, and depth does not tell them apart
  kLost,        // the tracker has lost the body: most joints are far off
  kUnknown,     // none of these
};
inline constexpr int kCauseCount = static_cast<int>(Cause::kUnknown) + 1;

std::string_view Name(Cause cause);     // "hidden"
std::string_view Meaning(Cause cause);  // a full sentence

}  // namespace vitruvia
