#include "reports/synthetic_experiment.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "body/body_model.h"
#include "geometry/zbuffer.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "math/statistics.h"
#include "metrics/joint_error.h"
#include "metrics/vertex_error.h"
#include "records/estimate.h"
#include "sequence/sequence.h"
#include "support/tiny_body.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kSequence = "sequences/wave";

PinholeCamera Camera() { return {160, 120, 142.5, 142.5, 79.5, 59.5}; }

// The camera stands 2.8 m in front of the subject, 1 m above the floor.
Vector3f InCamera(const Vector3f& p) { return {p.x(), 1.0f - p.y(), 2.8f - p.z()}; }

struct PosedBody {
  std::vector<Vector3f> vertices;
  std::vector<Vector3<double>> joints;
};

// Arms wave; `error_rad` turns the left forearm away from where it should be.
PosedBody Posed(const BodyModel& body, int frame, double error_rad) {
  JointPose pose = JointPose::Rest(body.skeleton);
  const auto bend = [&](BoneId bone, double angle_rad) {
    pose.local_rotations[static_cast<std::size_t>(bone)] = ExpSo3<double>({0.0, 0.0, angle_rad});
  };
  bend(BoneId::kLeftUpperArm, 0.9 * std::sin(0.4 * frame));
  bend(BoneId::kRightUpperArm, 0.9 * std::sin(0.4 * frame + 1.0));
  bend(BoneId::kLeftForearm, error_rad);
  const BoneTransforms bones = ForwardKinematics(body.skeleton, pose);
  PosedBody posed;
  SkinLinear(body.rest.vertices, body.weights, bones, posed.vertices);
  for (Vector3f& v : posed.vertices) v = InCamera(v);
  for (const auto& joint : PosedJoints(body.skeleton, bones)) {
    posed.joints.push_back(InCamera(joint.cast<float>()).cast<double>());
  }
  return posed;
}

void WriteSequence(const fs::path& folder, const BodyModel& body) {
  SequenceInfo info;
  info.camera = Camera();
  info.frames = kSyntheticFrames;
  for (const BoneInfo& bone : Bones()) info.joints.emplace_back(bone.joint);
  SequenceWriter writer(folder, info, body, body.rest);
  ZBuffer zbuffer(info.camera);
  for (int i = 0; i < kSyntheticFrames; ++i) {
    const PosedBody truth = Posed(body, i, 0.0);
    writer.Append(zbuffer.Render(truth.vertices, body.rest.triangles), truth.vertices,
                  {truth.joints, std::vector<bool>(truth.joints.size(), true)});
  }
  writer.Finish();
}

RunRecord NamedRun(const std::string& run_id, const std::string& scene) {
  RunRecord run;
  run.run_id = run_id;
  run.experiment = "synthetic";
  run.variant = "base";
  run.scene = scene;
  run.method = "realtime_scape";
  run.seed = 1;
  run.sequence_folder = fs::path("..") / kSequence;
  run.sequence_hash = "0123456789abcdef";
  run.config = {{"method", {{"lambda", 0.25}}}, {"scene", {{"frames", kSyntheticFrames}}}};
  run.provenance = {{"commit", "abcdef012345"}, {"compiler", "g++ <12>"}, {"threads", 1}};
  run.threshold_m = Thresholds(0.01, 0.2);
  run.steps = {
      {"2 kd-tree of P", 2.1, 2.6, 3.0}, {"5 render", 1.4, 1.5, 1.6}, {"own step", 0.5, 0.5, 0.5}};
  return run;
}

// Writes the estimate and scores it.
void WriteRun(const fs::path& experiment, RunRecord run, const BodyModel& body, double error_rad) {
  EstimateWriter writer(experiment / run.run_id / "estimate", body.rest);
  std::vector<double> joint_errors, frame_ms;
  for (int i = 0; i < kSyntheticFrames; ++i) {
    const PosedBody truth = Posed(body, i, 0.0);
    const PosedBody estimate = Posed(body, i, error_rad * std::sin(0.5 * i));
    TrackResult result;
    const bool failed = run.run_id == kOtherScene && i % 5 == 4;
    result.outcome = failed ? Outcome::kLost : Outcome::kConverged;
    result.message = failed ? "2 of 3 vertices are unsupported" : "";
    result.vertices = estimate.vertices;
    result.joints = estimate.joints;
    result.iterations = 3;
    if (run.run_id == kWavingRun) {  // 3, 4 and 12 mm, the first two tilted by 45°
      Matrix3<double> covariance_m2;
      covariance_m2 << 1.25e-5, 3.5e-6, 0.0, 3.5e-6, 1.25e-5, 0.0, 0.0, 0.0, 1.44e-4;
      result.joint_covariances.assign(estimate.joints.size(), covariance_m2);
    }
    frame_ms.push_back(10.0 + i + 8.0 * error_rad);
    writer.Append(result, frame_ms.back());

    const std::vector<double> errors = VertexErrors(estimate.vertices, truth.vertices);
    run.frames["l2_mean_m"].push_back(Mean(errors));
    run.frames["l2_max_m"].push_back(Maximum(errors));
    run.frames["l2_mean_hidden_m"].push_back(kNoValue);
    run.frames["frame_ms"].push_back(frame_ms.back());
    run.frames["failed"].push_back(failed ? 1.0 : 0.0);
    for (const double e : JointErrors(estimate.joints, truth.joints)) joint_errors.push_back(e);
  }
  writer.Finish();
  run.diagonal_m = BoundingBoxDiagonal(body.rest.vertices);
  for (const std::string joints : {"all", "visible"}) {
    run.joint_accuracy[joints] = AccuracyCurve(joint_errors, run.threshold_m);
  }
  run.summary = {{"run_id", run.run_id},
                 {"variant", run.variant},
                 {"scene", run.scene},
                 {"seed", run.seed},
                 {"frames", kSyntheticFrames},
                 {"frames_failed", run.run_id == kOtherScene ? 2 : 0},
                 {"l2_mean_m", Mean(run.frames["l2_mean_m"])},
                 {"l2_mean_of_diagonal", Mean(run.frames["l2_mean_m"]) / run.diagonal_m},
                 {"l2_max_of_diagonal", Maximum(run.frames["l2_max_m"]) / run.diagonal_m},
                 {"joint_error_mean_m", Mean(joint_errors)},
                 {"joints_within_10cm", ShareWithin(joint_errors, 0.1)},
                 {"frame_ms_median", Quantile(frame_ms, 0.5)},
                 {"frame_ms_p95", Quantile(frame_ms, 0.95)},
                 {"iterations_mean", 3.0}};
  WriteRunRecord(experiment, run);
}

ExperimentRecord Experiment() {
  ExperimentRecord e;
  e.name = "synthetic";
  e.title = "A figure of boxes <waving>";
  e.description = "Three runs, one that failed & one that is missing.";
  e.expectations = {{"l2_mean_of_diagonal", 0.001, 0.001, "paper A, figure 11",
                     "a figure of boxes, not a person"},
                    {"l2_max_of_diagonal", 0.03, kNoValue, "paper A, figure 11",
                     "a figure of boxes, not a person"},
                    {"frame_ms_median", 25.0, 25.0, "paper A, table 1", "another CPU"}};
  e.picture_frames = {0, kPictureFrame, 999};  // the last is beyond the sequence's end
  e.run_ids = {kWavingRun, kExactRun, kOtherScene, kFailedRun, kMissingRun};
  e.failed_runs = {{kFailedRun, "sequences/turn/depth/000003.png: file is cut short"}};
  return e;
}

}  // namespace

fs::path WriteSyntheticExperiment(const fs::path& root) {
  const BodyModel body = TinyBody(3);
  WriteSequence(root / kSequence, body);
  const fs::path folder = root / "synthetic";
  WriteRun(folder, NamedRun(kWavingRun, "wave"), body, 0.25);
  WriteRun(folder, NamedRun(kExactRun, "wave"), body, 0.0);
  WriteRun(folder, NamedRun(kOtherScene, "turn"), body, 0.6);
  WriteExperimentRecord(folder, Experiment());
  return folder;
}

}  // namespace vitruvia
