// The part of a score (score.h) that compares joints.
#pragma once

#include <string>
#include <vector>

#include "records/estimate.h"
#include "records/run_record.h"
#include "sequence/sequence.h"

namespace vitruvia {

// Fills what the record says of joints. Compared are those that the sequence and the skeleton have
// in common by name, in the frames in which the sequence knows them. Without any the record says
// nothing of joints.
void ScoreJoints(const SequenceReader& sequence, const EstimateReader& estimate, RunRecord& record);

// Errors of each compared joint in each frame: [frame][joint], NaN where the truth is not known.
struct JointErrorsOfFrames {
  std::vector<std::string> joints;
  std::vector<std::vector<double>> errors_m;
};
JointErrorsOfFrames FindJointErrors(const SequenceReader& sequence, const EstimateReader& estimate);

}  // namespace vitruvia
