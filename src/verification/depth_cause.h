// Finds the change of a sequence that would make its depth agree with its truth. Internal to this
// module.
#pragma once

#include <string>
#include <vector>

#include "sequence/sequence.h"
#include "verification/depth_agreement.h"
#include "verification/joint_agreement.h"

namespace vitruvia {

// With fewer joints no cause is determined.
inline constexpr int kFewestJoints = 8;

JointAgreement CompareWithJoints(const SequenceReader& sequence, const std::vector<int>& frames);

// Tries units, byte order, mirror images, axes, cameras of other resolutions and shifts in time on
// a few frames. Returns a text with the cause and its evidence, or one that says that no simple
// cause was found.
std::string CauseOfDisagreement(const SequenceReader& sequence, const DepthAgreement& as_stated);
std::string CauseOfDisagreement(const SequenceReader& sequence, const JointAgreement& as_stated);

}  // namespace vitruvia
