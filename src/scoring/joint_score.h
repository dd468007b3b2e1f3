// The part of a score (score.h) that compares joints.
#pragma once

#include <string>
#include <vector>

#include "records/estimate.h"
#include "records/run_record.h"
#include "sequence/sequence.h"

namespace vitruvia {

// Fills the record's joint metrics. They compare the joints that the sequence and the skeleton have
// in common by name, in the frames in which the sequence knows them. Without such joints, nothing
// is filled.
void ScoreJoints(const SequenceReader& sequence, const EstimateReader& estimate, RunRecord& record);

// Errors of each compared joint in each frame: [frame][joint], NaN where the truth is not known.
struct JointErrorsOfFrames {
  std::vector<std::string> joints;
  std::vector<std::vector<double>> errors_m;
};
JointErrorsOfFrames FindJointErrors(const SequenceReader& sequence, const EstimateReader& estimate);

}  // namespace vitruvia
