// The change of a sequence that would make its depth agree with its truth. For this module's own
// files.
#pragma once

#include <string>
#include <vector>

#include "sequence/sequence.h"
#include "verification/depth_agreement.h"
#include "verification/joint_agreement.h"

namespace vitruvia {

// Fewer joints say nothing.
inline constexpr int kFewestJoints = 8;

JointAgreement CompareWithJoints(const SequenceReader& sequence, const std::vector<int>& frames);

// Tries units, byte order, mirror images, axes, cameras of other resolutions and shifts in time on
// a few frames. The cause in words, with its evidence; or that there is no simple one.
std::string CauseOfDisagreement(const SequenceReader& sequence, const DepthAgreement& as_stated);
std::string CauseOfDisagreement(const SequenceReader& sequence, const JointAgreement& as_stated);

}  // namespace vitruvia
