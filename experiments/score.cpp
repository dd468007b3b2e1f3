#include "experiments/score.h"

#include "body/skeleton.h"
#include "core/error.h"
#include "metrics/joint_error.h"
#include "metrics/statistics.h"
#include "metrics/vertex_error.h"

namespace vitruvia {
namespace {

// Joint errors of all frames, sorted by what the camera could see.
struct JointErrorsByClass {
  std::vector<double> all, visible, hidden;
  std::map<std::string, std::vector<double>> per_joint;
};

// Joints are compared one to one, so both sides must speak of the same ones.
void RequireMatch(const SequenceReader& sequence, const EstimateReader& estimate) {
  const std::string where = sequence.folder().string();
  const SequenceInfo& info = sequence.info();
  if (static_cast<int>(estimate.frames().size()) != info.frames) {
    throw DataError(fmt::format("{}: the estimate has {} frames, the sequence {}", where,
                                estimate.frames().size(), info.frames));
  }
  for (int j = 0; j < kBoneCount; ++j) {
    const std::string_view expected = Bones()[j].joint;
    if (info.joints.size() == kBoneCount && info.joints[j] == expected) continue;
    throw DataError(
        fmt::format("{}: joint {} is \"{}\"; estimates are scored by {} joints, there \"{}\"",
                    where, j, j < static_cast<int>(info.joints.size()) ? info.joints[j] : "missing",
                    kBoneCount, expected));
  }
  for (const FrameEstimate& frame : estimate.frames()) {
    if (frame.joints.size() == info.joints.size()) continue;
    throw DataError(fmt::format("{}: the estimate has {} joints, the sequence {}", where,
                                frame.joints.size(), info.joints.size()));
  }
}

void ScoreSurface(const SequenceReader& sequence, const EstimateReader& estimate,
                  RunRecord& record) {
  const RestCorrespondence correspondence(estimate.rest_mesh(), sequence.true_rest_mesh());
  const PinholeCamera& camera = sequence.info().camera;
  ZBuffer zbuffer(camera);
  for (int frame = 0; frame < sequence.info().frames; ++frame) {
    const std::vector<Vector3f> true_vertices = sequence.ReadTrueVertices(frame);
    const std::vector<Vector3f> truth = correspondence.TruePositions(true_vertices);
    const DepthImage& rendered = zbuffer.Render(true_vertices, sequence.true_rest_mesh().triangles);
    const VertexErrorSummary error =
        Summarize(VertexErrors(estimate.ReadVertices(frame), truth),
                  VisiblePoints(truth, rendered, camera, kVisibleWithin_m));
    record.frames["l2_mean_m"].push_back(error.mean_m);
    record.frames["l2_max_m"].push_back(error.max_m);
    record.frames["l2_mean_visible_m"].push_back(error.visible_mean_m);
    record.frames["l2_max_visible_m"].push_back(error.visible_max_m);
    record.frames["l2_mean_hidden_m"].push_back(error.hidden_mean_m);
    record.frames["l2_max_hidden_m"].push_back(error.hidden_max_m);
  }
}

JointErrorsByClass ScoreJoints(const SequenceReader& sequence, const EstimateReader& estimate,
                               RunRecord& record) {
  JointErrorsByClass errors;
  for (int frame = 0; frame < sequence.info().frames; ++frame) {
    const JointTruth& truth = sequence.true_joints(frame);
    const std::vector<double> frame_errors =
        JointErrors(estimate.frames()[frame].joints, truth.positions);
    for (std::size_t j = 0; j < frame_errors.size(); ++j) {
      errors.all.push_back(frame_errors[j]);
      (truth.visible[j] ? errors.visible : errors.hidden).push_back(frame_errors[j]);
      errors.per_joint[sequence.info().joints[j]].push_back(frame_errors[j]);
    }
    record.frames["joint_error_mean_m"].push_back(Mean(frame_errors));
    record.frames["joint_error_max_m"].push_back(Maximum(frame_errors));
  }
  return errors;
}

void RecordOutcomes(const EstimateReader& estimate, RunRecord& record) {
  for (const FrameEstimate& frame : estimate.frames()) {
    record.frames["frame_ms"].push_back(frame.frame_ms);
    record.frames["iterations"].push_back(frame.iterations);
    record.frames["failed"].push_back(IsFailure(frame.outcome) ? 1.0 : 0.0);
    record.frames["condition"].push_back(frame.condition);
    for (const NamedValue& energy : frame.energies)
      record.frames["energy_" + energy.name].push_back(energy.value);
  }
}

std::vector<RunRecord::Step> StepTimes(const EstimateReader& estimate) {
  std::vector<RunRecord::Step> steps;
  for (std::size_t k = 0; k < estimate.frames().front().step_ms.size(); ++k) {
    std::vector<double> ms;
    for (const FrameEstimate& frame : estimate.frames()) ms.push_back(frame.step_ms.at(k).value);
    steps.push_back({estimate.frames().front().step_ms[k].name, Quantile(ms, 0.5),
                     Quantile(ms, 0.95), Maximum(ms)});
  }
  return steps;
}

void SummarizeRun(const JointErrorsByClass& joints, RunRecord& record) {
  const auto& f = record.frames;
  const auto mean = [&](const char* key) { return Mean(f.at(key)); };
  const auto max = [&](const char* key) { return Maximum(f.at(key)); };
  const std::vector<double>& frame_ms = f.at("frame_ms");
  nlohmann::json& row = record.summary;
  row["frames"] = frame_ms.size();
  row["frames_failed"] =
      static_cast<int>(mean("failed") * static_cast<double>(frame_ms.size()) + 0.5);
  row["diagonal_m"] = record.diagonal_m;
  row["l2_mean_m"] = mean("l2_mean_m");
  row["l2_max_m"] = max("l2_max_m");
  row["l2_mean_visible_m"] = mean("l2_mean_visible_m");
  row["l2_mean_hidden_m"] = mean("l2_mean_hidden_m");
  row["l2_max_visible_m"] = max("l2_max_visible_m");
  row["l2_max_hidden_m"] = max("l2_max_hidden_m");
  row["l2_mean_of_diagonal"] = mean("l2_mean_m") / record.diagonal_m;
  row["l2_max_of_diagonal"] = max("l2_max_m") / record.diagonal_m;
  row["joint_error_mean_m"] = Mean(joints.all);
  row["joint_error_mean_visible_m"] = Mean(joints.visible);
  row["joint_error_mean_hidden_m"] = Mean(joints.hidden);
  row["joint_error_max_m"] = Maximum(joints.all);
  row["joints_within_10cm"] = ShareWithin(joints.all, kJointThreshold_m);
  row["frame_ms_median"] = Quantile(frame_ms, 0.5);
  row["frame_ms_p95"] = Quantile(frame_ms, 0.95);
  row["frame_ms_max"] = Maximum(frame_ms);
  row["iterations_mean"] = mean("iterations");
  row["condition_max"] = max("condition");
}

}  // namespace

void ScoreRun(const SequenceReader& sequence, const EstimateReader& estimate, RunRecord& record) {
  RequireMatch(sequence, estimate);
  record.diagonal_m = BoundingBoxDiagonal(sequence.true_rest_mesh().vertices);
  ScoreSurface(sequence, estimate, record);
  const JointErrorsByClass joints = ScoreJoints(sequence, estimate, record);
  RecordOutcomes(estimate, record);
  record.threshold_m = Thresholds(kCurveStep_m, kCurveLast_m);
  record.joint_accuracy["all"] = AccuracyCurve(joints.all, record.threshold_m);
  record.joint_accuracy["visible"] = AccuracyCurve(joints.visible, record.threshold_m);
  record.joint_accuracy["hidden"] = AccuracyCurve(joints.hidden, record.threshold_m);
  for (const auto& [joint, errors] : joints.per_joint)
    record.joint_error_mean_m[joint] = Mean(errors);
  record.steps = StepTimes(estimate);
  SummarizeRun(joints, record);
}

}  // namespace vitruvia
