#include "experiments/score.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "body/skeleton.h"
#include "core/error.h"
#include "experiments/run_health.h"
#include "matching/point_cloud.h"
#include "metrics/bone_motion.h"
#include "metrics/joint_error.h"
#include "metrics/reconstruction_error.h"
#include "metrics/statistics.h"
#include "metrics/vertex_error.h"

namespace vitruvia {
namespace {

// Joint errors of all frames, sorted by what the camera could see.
struct JointErrorsByClass {
  std::vector<double> all, visible, hidden;
  std::vector<double> less_offset;  // of all, each joint's mean offset taken off
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

// Vertices that nearly follow one bone alone show how it turns.
constexpr float kRigidWeight = 0.9f;
RigidParts PartsOf(const BodyModel& subject) {
  std::vector<int> bone_of_vertex;
  for (std::size_t i = 0; i < subject.rest.vertices.size(); ++i) {
    const bool rigid = subject.weights.weights[i][0] >= kRigidWeight;
    bone_of_vertex.push_back(rigid ? subject.weights.bones[i][0] : -1);
  }
  return {subject.rest.vertices, bone_of_vertex, kBoneCount};
}

// The axes about which limbs can twist; zero for all other bones.
std::vector<Vector3d> LimbAxes(const Skeleton& skeleton) {
  std::vector<Vector3d> axes(kBoneCount, Vector3d::Zero());
  for (const BoneId id :
       {BoneId::kLeftUpperArm, BoneId::kLeftForearm, BoneId::kRightUpperArm, BoneId::kRightForearm,
        BoneId::kLeftThigh, BoneId::kLeftShin, BoneId::kRightThigh, BoneId::kRightShin}) {
    const int j = static_cast<int>(id);
    axes[j] = (skeleton.tips[j] - skeleton.joints[j]).normalized();
  }
  return axes;
}

// How the bones of both surfaces turned. Only where the estimate moves the sequence's own template.
class TurnWatch {
 public:
  TurnWatch(const SequenceReader& sequence, const EstimateReader& estimate)
      : parts_(PartsOf(sequence.subject())),
        axes_(LimbAxes(sequence.subject().skeleton)),
        fps_(sequence.info().fps),
        applies_(estimate.rest_mesh().vertices.size() == sequence.subject().rest.vertices.size()) {}

  void Add(const std::vector<Vector3f>& estimate, const std::vector<Vector3f>& truth) {
    if (!applies_) return;
    estimate_.push_back(parts_.Rotations(estimate));
    truth_.push_back(parts_.Rotations(truth));
  }

  void Summarize(nlohmann::json& row) const {
    if (!applies_) return;
    row["jitter_rms_rad_s2"] = AngularJitter(estimate_, truth_, fps_);
    row["twist_rms_deg"] = TwistError(estimate_, truth_, axes_) * 180.0 / std::numbers::pi;
  }

 private:
  RigidParts parts_;
  std::vector<Vector3d> axes_;
  double fps_;
  bool applies_;
  std::vector<BoneRotations> estimate_, truth_;
};

void RecordQuantiles(std::vector<double> errors_m, RunRecord& record) {
  std::sort(errors_m.begin(), errors_m.end());  // once for all
  record.frames["l2_median_m"].push_back(Quantile(errors_m, 0.5));
  record.frames["l2_p95_m"].push_back(Quantile(errors_m, 0.95));
  record.frames["l2_p99_m"].push_back(Quantile(errors_m, 0.99));
}

std::vector<Vector3f> Chosen(const std::vector<Vector3f>& points, const std::vector<bool>& chosen) {
  std::vector<Vector3f> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (chosen[i]) kept.push_back(points[i]);
  }
  return kept;
}

// How far the estimate's visible vertices lie from what was observed (paper B, figure 6), and from
// the true surface, which the paper could not have. Summed over every n-th frame.
class ReconstructionWatch {
 public:
  ReconstructionWatch(const SequenceReader& sequence, const EstimateReader& estimate, int every)
      : camera_(sequence.info().camera),
        triangles_(estimate.rest_mesh().triangles),
        every_(every),
        zbuffer_(camera_) {}

  void Add(int frame, const std::vector<Vector3f>& estimate, const DepthImage& observed,
           const TriangleMesh& truth) {
    if (every_ == 0 || frame % every_ != 0) return;
    const DepthImage& seen = zbuffer_.Render(estimate, triangles_);
    const std::vector<Vector3f> visible =
        Chosen(estimate, VisiblePoints(estimate, seen, camera_, kVisibleWithin_m));
    CloudFromDepth(observed, camera_, 1, std::numeric_limits<float>::infinity(), cloud_);
    Append(DistancesToPoints(visible, cloud_.points), to_observed_m_);
    Append(DistancesToSurface(visible, truth), to_truth_m_);
  }

  void Summarize(nlohmann::json& row) const {
    if (every_ == 0) return;
    row["reconstruction_mean_m"] = Mean(to_observed_m_);
    row["reconstruction_p95_m"] = Quantile(to_observed_m_, 0.95);
    row["surface_visible_mean_m"] = Mean(to_truth_m_);
    row["surface_visible_p95_m"] = Quantile(to_truth_m_, 0.95);
  }

 private:
  static void Append(const std::vector<double>& distances, std::vector<double>& all) {
    all.insert(all.end(), distances.begin(), distances.end());
  }

  PinholeCamera camera_;
  const std::vector<Triangle>& triangles_;
  int every_;
  ZBuffer zbuffer_;
  PointCloud cloud_;
  std::vector<double> to_observed_m_, to_truth_m_;
};

void ScoreSurface(const SequenceReader& sequence, const EstimateReader& estimate,
                  const ScoreSettings& settings, RunRecord& record) {
  ReconstructionWatch reconstruction(sequence, estimate, settings.reconstruction_every);
  TriangleMesh true_surface = sequence.true_rest_mesh();
  TurnWatch turns(sequence, estimate);
  const RestCorrespondence correspondence(estimate.rest_mesh(), sequence.true_rest_mesh());
  const PinholeCamera& camera = sequence.info().camera;
  ZBuffer zbuffer(camera);
  for (int frame = 0; frame < sequence.info().frames; ++frame) {
    true_surface.vertices = sequence.ReadTrueVertices(frame);
    const std::vector<Vector3f> truth = correspondence.TruePositions(true_surface.vertices);
    const DepthImage& rendered = zbuffer.Render(true_surface.vertices, true_surface.triangles);
    const std::vector<Vector3f> estimated = estimate.ReadVertices(frame);
    turns.Add(estimated, truth);
    reconstruction.Add(frame, estimated, sequence.ReadDepth(frame), true_surface);
    const std::vector<double> errors_m = VertexErrors(estimated, truth);
    const VertexErrorSummary error =
        Summarize(errors_m, VisiblePoints(truth, rendered, camera, kVisibleWithin_m));
    record.frames["l2_mean_m"].push_back(error.mean_m);
    record.frames["l2_max_m"].push_back(error.max_m);
    RecordQuantiles(errors_m, record);
    record.frames["l2_mean_visible_m"].push_back(error.visible_mean_m);
    record.frames["l2_max_visible_m"].push_back(error.visible_max_m);
    record.frames["l2_mean_hidden_m"].push_back(error.hidden_mean_m);
    record.frames["l2_max_hidden_m"].push_back(error.hidden_max_m);
  }
  turns.Summarize(record.summary);
  reconstruction.Summarize(record.summary);
}

JointErrorsByClass ScoreJoints(const SequenceReader& sequence, const EstimateReader& estimate,
                               RunRecord& record) {
  JointErrorsByClass errors;
  std::vector<std::vector<Vector3d>> estimates, truths;
  for (int frame = 0; frame < sequence.info().frames; ++frame) {
    const JointTruth& truth = sequence.true_joints(frame);
    estimates.push_back(estimate.frames()[frame].joints);
    truths.push_back(truth.positions);
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
  for (const std::vector<double>& frame_errors : JointErrorsLessOffset(estimates, truths))
    errors.less_offset.insert(errors.less_offset.end(), frame_errors.begin(), frame_errors.end());
  return errors;
}

void RecordOutcomes(const EstimateReader& estimate, RunRecord& record) {
  for (const FrameEstimate& frame : estimate.frames()) {
    record.frames["frame_ms"].push_back(frame.frame_ms);
    record.frames["iterations"].push_back(frame.iterations);
    record.frames["failed"].push_back(IsFailure(frame.outcome) ? 1.0 : 0.0);
    record.frames["condition"].push_back(frame.condition);
    record.frames["rotation_drift"].push_back(frame.rotation_drift);
    record.frames["energy_rise"].push_back(frame.energy_rise);
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
  row["joints_within_10cm_less_offset"] = ShareWithin(joints.less_offset, kJointThreshold_m);
  row["joint_auc_30cm"] = Mean(record.joint_accuracy.at("all"));
  row["frame_ms_median"] = Quantile(frame_ms, 0.5);
  row["frame_ms_p95"] = Quantile(frame_ms, 0.95);
  row["frame_ms_max"] = Maximum(frame_ms);
  row["iterations_mean"] = mean("iterations");
  if (!record.variant.empty()) row["case"] = record.variant;
  SummarizeHealth(record, row);
}

}  // namespace

void ScoreSettings::Describe(Fields& f) {
  f.Integer(
      "reconstruction_every", reconstruction_every,
      {.meaning = "every how many frames visible vertices are held against the observed points "
                  "and against the true surface; 0 is never",
       .unit = "frames",
       .min = 0,
       .max = 1e6,
       .origin = Origin::kInput});
}

void ScoreRun(const SequenceReader& sequence, const EstimateReader& estimate,
              const ScoreSettings& settings, RunRecord& record) {
  RequireMatch(sequence, estimate);
  record.diagonal_m = BoundingBoxDiagonal(sequence.true_rest_mesh().vertices);
  ScoreSurface(sequence, estimate, settings, record);
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
