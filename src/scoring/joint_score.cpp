#include "scoring/joint_score.h"

#include <algorithm>
#include <limits>

#include "body/skeleton.h"
#include "core/error.h"
#include "math/statistics.h"
#include "metrics/joint_error.h"
#include "scoring/score.h"

namespace vitruvia {
namespace {

// Beside the papers' kJointThreshold_m, for differences that it does not show.
constexpr double kTightThreshold_m = 0.02, kMiddleThreshold_m = 0.05;

// A joint that both sides have.
struct SharedJoint {
  std::string name;
  std::size_t in_sequence, in_skeleton;
};

std::vector<SharedJoint> SharedJoints(const std::vector<std::string>& joints_of_sequence) {
  std::vector<SharedJoint> shared;
  for (std::size_t j = 0; j < joints_of_sequence.size(); ++j) {
    const int bone = FindJoint(joints_of_sequence[j]);
    if (bone >= 0) shared.push_back({joints_of_sequence[j], j, static_cast<std::size_t>(bone)});
  }
  return shared;
}

// Shared joints of all frames, [frame][joint]; the truth is NaN where it is not known.
struct JointTracks {
  std::vector<std::vector<Vector3d>> estimates, truths;
};

JointTracks TracksOf(const SequenceReader& sequence, const EstimateReader& estimate,
                     const std::vector<SharedJoint>& shared) {
  const Vector3d unknown = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  JointTracks tracks;
  for (int frame = 0; frame < sequence.info().frames; ++frame) {
    const JointTruth& truth = sequence.true_joints(frame);
    std::vector<Vector3d> estimated, known;
    for (const SharedJoint& joint : shared) {
      estimated.push_back(estimate.frames()[frame].joints[joint.in_skeleton]);
      known.push_back(truth.Knows(joint.in_sequence) ? truth.positions[joint.in_sequence]
                                                     : unknown);
    }
    tracks.estimates.push_back(std::move(estimated));
    tracks.truths.push_back(std::move(known));
  }
  return tracks;
}

// Errors of all frames, sorted by what the camera could see.
struct JointErrorsByClass {
  std::vector<double> all, visible, hidden;
  std::vector<double> less_offset;  // of all, each joint's mean offset taken off
  std::map<std::string, std::vector<double>> per_joint;
};

double MeanOrNone(const std::vector<double>& values) {
  return values.empty() ? std::numeric_limits<double>::quiet_NaN() : Mean(values);
}

JointErrorsByClass Classified(const SequenceReader& sequence, const JointTracks& tracks,
                              const std::vector<SharedJoint>& shared, RunRecord& record) {
  JointErrorsByClass errors;
  const std::vector<std::vector<double>> less_offset =
      JointErrorsLessOffset(tracks.estimates, tracks.truths);
  for (int frame = 0; frame < sequence.info().frames; ++frame) {
    const JointTruth& truth = sequence.true_joints(frame);
    const std::vector<double> distances =
        JointErrors(tracks.estimates[frame], tracks.truths[frame]);
    std::vector<double> of_frame;
    for (std::size_t k = 0; k < shared.size(); ++k) {
      const std::size_t j = shared[k].in_sequence;
      if (!truth.Knows(j)) continue;
      of_frame.push_back(distances[k]);
      (truth.visible[j] ? errors.visible : errors.hidden).push_back(distances[k]);
      errors.per_joint[shared[k].name].push_back(distances[k]);
      errors.less_offset.push_back(less_offset[frame][k]);
    }
    errors.all.insert(errors.all.end(), of_frame.begin(), of_frame.end());
    record.frames["joint_error_mean_m"].push_back(MeanOrNone(of_frame));
    record.frames["joint_error_max_m"].push_back(of_frame.empty() ? MeanOrNone({})
                                                                  : Maximum(of_frame));
  }
  return errors;
}

void RecordCurves(const JointErrorsByClass& errors, RunRecord& record) {
  record.threshold_m = Thresholds(kCurveStep_m, kCurveLast_m);
  const auto curve = [&record](const char* name, const std::vector<double>& of_class) {
    if (!of_class.empty())
      record.joint_accuracy[name] = AccuracyCurve(of_class, record.threshold_m);
  };
  curve("all", errors.all);
  curve("visible", errors.visible);
  curve("hidden", errors.hidden);
  curve("less_offset", errors.less_offset);
  for (const auto& [joint, of_joint] : errors.per_joint)
    record.joint_error_mean_m[joint] = Mean(of_joint);
}

void SummarizeJointErrors(const JointErrorsByClass& errors, RunRecord& record) {
  nlohmann::json& row = record.summary;
  row["joint_error_mean_m"] = Mean(errors.all);
  if (!errors.visible.empty()) row["joint_error_mean_visible_m"] = Mean(errors.visible);
  if (!errors.hidden.empty()) row["joint_error_mean_hidden_m"] = Mean(errors.hidden);
  row["joint_error_max_m"] = Maximum(errors.all);
  row["joints_within_2cm"] = ShareWithin(errors.all, kTightThreshold_m);
  row["joints_within_5cm"] = ShareWithin(errors.all, kMiddleThreshold_m);
  row["joints_within_10cm"] = ShareWithin(errors.all, kJointThreshold_m);
  row["joint_error_mean_less_offset_m"] = Mean(errors.less_offset);
  row["joints_within_10cm_less_offset"] = ShareWithin(errors.less_offset, kJointThreshold_m);
  row["joint_auc_30cm"] = Mean(record.joint_accuracy.at("all"));
}

void RequireJoints(const EstimateReader& estimate, const std::string& where) {
  for (const FrameEstimate& frame : estimate.frames()) {
    if (frame.joints.size() == static_cast<std::size_t>(kBoneCount)) continue;
    throw DataError(fmt::format("{}: the estimate has {} joints, the skeleton {}", where,
                                frame.joints.size(), kBoneCount));
  }
}

}  // namespace

JointErrorsOfFrames FindJointErrors(const SequenceReader& sequence,
                                    const EstimateReader& estimate) {
  RequireJoints(estimate, sequence.folder().string());
  const std::vector<SharedJoint> shared = SharedJoints(sequence.info().joints);
  const JointTracks tracks = TracksOf(sequence, estimate, shared);
  JointErrorsOfFrames errors;
  for (const SharedJoint& joint : shared) errors.joints.push_back(joint.name);
  for (int frame = 0; frame < sequence.info().frames; ++frame) {
    std::vector<double> of_frame = JointErrors(tracks.estimates[frame], tracks.truths[frame]);
    for (std::size_t k = 0; k < shared.size(); ++k) {
      if (!sequence.true_joints(frame).Knows(shared[k].in_sequence)) of_frame[k] = kAbsent;
    }
    errors.errors_m.push_back(std::move(of_frame));
  }
  return errors;
}

void ScoreJoints(const SequenceReader& sequence, const EstimateReader& estimate,
                 RunRecord& record) {
  RequireJoints(estimate, sequence.folder().string());
  const std::vector<SharedJoint> shared = SharedJoints(sequence.info().joints);
  if (shared.empty()) return;
  const JointTracks tracks = TracksOf(sequence, estimate, shared);
  const JointErrorsByClass errors = Classified(sequence, tracks, shared, record);
  if (errors.all.empty()) return;
  RecordCurves(errors, record);
  SummarizeJointErrors(errors, record);
}

}  // namespace vitruvia
