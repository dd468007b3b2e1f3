// The part of a score (score.h) that says how soon lost limbs are found again.
#pragma once

#include "records/estimate.h"
#include "records/run_record.h"
#include "sequence/sequence.h"

namespace vitruvia {

// Adds limb_losses and, if there are any, limbs_found_within_10_frames to the row. A limb (an arm
// or a leg) is lost in a frame in which its elbow or wrist (knee or ankle) is more than 10 cm off,
// and visible in one in which the camera sees a fifth of the vertices of its forearm and hand (shin
// and foot). A frame in which the truth of one of its joints is unknown and the other
// one is in place is left out. Needs the true joints of all four limbs, a true surface and the
// sequence's own subject, whose vertices say what is visible; without them nothing is added.
void ScoreLimbs(const SequenceReader& sequence, const EstimateReader& estimate, RunRecord& record);

}  // namespace vitruvia
