#include "methods/scape_regression/scape_regression.h"

#include <optional>

#include "core/error.h"
#include "geometry/point_cloud.h"
#include "math/rotation.h"
#include "methods/scape_regression/frame_fit.h"
#include "tracking/frame_checks.h"

namespace vitruvia::scape_regression {
namespace {

PoseRegression Read(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder / kPoseRegressionFile)) {
    throw ConfigError(fmt::format(
        "regression: {} holds no pose regression; make one: vitruvia learn pose-regression "
        "configs/pose_regression/mannequin.json -o {}",
        folder.string(), folder.string()));
  }
  return ReadPoseRegression(folder);
}

// Predicts the next pose by a share of the motion from `before` to `last`.
ScapePose Predicted(const ScapePose& before, const ScapePose& last, double share) {
  ScapePose pose = last;
  pose.center += share * (last.center - before.center);
  for (int b = 0; b < kBoneCount; ++b) {
    const Matrix3<double> turn = last.rotations[b] * before.rotations[b].transpose();
    pose.rotations[b] = ExpSo3<double>(share * LogSo3<double>(turn)) * last.rotations[b];
  }
  return pose;
}

}  // namespace

struct ScapeRegression::Session {
  Session(const Subject& model, const PinholeCamera& view, const PoseRegression& regression,
          const Settings& settings)
      : subject(model),
        camera(view),
        body(model, OnMesh(regression, model)),
        fit(body, view, settings),
        vertices(model.rest.vertices),
        motions(kBoneCount) {
    if (settings.start == Start::kSearch)
      start_search.emplace(model, view, settings.max_depth_m, settings.start_search);
  }

  Subject subject;
  PinholeCamera camera;
  ScapeBody body;
  FrameFit fit;
  std::optional<StartSearch> start_search;
  std::string start_message;  // of the last search
  StepClock<TimedStep> clock;

  // Carried from frame to frame.
  std::optional<ScapePose> last, before;
  std::vector<Vector3f> vertices;
  BoneTransforms motions;
};

ScapeRegression::ScapeRegression(const Settings& settings)
    : ScapeRegression(settings, Read(settings.regression)) {}

ScapeRegression::ScapeRegression(const Settings& settings, PoseRegression regression)
    : settings_(settings), regression_(std::move(regression)) {}

ScapeRegression::~ScapeRegression() = default;

void ScapeRegression::Start(const Subject& subject, const PinholeCamera& camera) {
  CheckBodyModel(subject, fmt::format("scape_regression cannot use subject {}", subject.name));
  session_ = std::make_unique<Session>(subject, camera, regression_, settings_);
}

TrackResult ScapeRegression::TrackFrame(const DepthFrame& frame) {
  Require(session_ != nullptr, "TrackFrame called before Start");
  Session& s = *session_;
  CheckFrameSize(frame, s.camera);
  s.clock.Restart();
  TrackResult result;
  PointCloud cloud;
  CloudFromDepth(frame.depth, s.camera, 2, static_cast<float>(settings_.max_depth_m), cloud);
  const bool is_first = !s.last;
  if (cloud.points.empty()) {
    result.outcome = Outcome::kNoData;
    result.message = kNoMeasurement;
  } else if (is_first) {
    s.last = FirstPose(frame, cloud);
  }
  FitResult fit;
  if (!cloud.points.empty() && s.last) {
    const ScapePose start =
        s.before ? Predicted(*s.before, *s.last, settings_.fit.prediction) : *s.last;
    fit = s.fit.Fit(frame.depth, start, *s.last,
                    is_first ? settings_.fit.first_frame_iterations : settings_.fit.iterations,
                    s.vertices, s.clock);
    const bool is_lost = fit.supported < settings_.lost_below;
    s.before = is_first || is_lost ? fit.pose : *s.last;
    s.last = fit.pose;
    s.motions = s.body.PartMotions(s.vertices);
    ReportOutcome(fit, result);
  } else if (!cloud.points.empty()) {
    result.outcome = Outcome::kLost;
    result.message = s.start_message;
  }
  result.vertices = s.vertices;
  result.camera_from_rest = s.motions;
  result.joints = s.body.Joints(s.motions);
  result.iterations = fit.iterations;
  result.energies = {{"depth", fit.energies.depth},
                     {"contour", fit.energies.contour},
                     {"pose_change", fit.energies.pose_change},
                     {"pose", fit.energies.pose}};
  s.clock.Lap(TimedStep::kSurface);
  result.step_ms = s.clock.times().Named();
  return result;
}

// Nothing if a search does not find the subject.
std::optional<ScapePose> ScapeRegression::FirstPose(const DepthFrame& frame,
                                                    const PointCloud& cloud) {
  Session& s = *session_;
  if (s.start_search) {
    const FoundStart found = s.start_search->Find(frame.depth, frame.known);
    s.start_message = found.message;
    if (!found.found) return {};
    return s.body.PoseOf(found.camera_from_rest);
  }
  const std::unique_ptr<MeshRasterizer> rasterizer =
      MakeRasterizer(Rasterizer::kFrontFaces, s.camera);
  return s.body.RestPose(PlaceRestPose({s.subject.rest.vertices, s.subject.rest.triangles}, cloud,
                                       s.camera, settings_.visible_within_m, settings_.placement,
                                       *rasterizer));
}

void ScapeRegression::ReportOutcome(const FitResult& fit, TrackResult& result) const {
  if (fit.supported < settings_.lost_below) {
    result.outcome = Outcome::kLost;
    result.message =
        fmt::format("the depth confirms {:.0f} % of the visible vertices", 100.0 * fit.supported);
  } else if (fit.converged) {
    result.outcome = Outcome::kConverged;
  } else {
    result.outcome = Outcome::kIterationLimit;
    result.message = fmt::format("still moving after {} steps", fit.iterations);
  }
}

}  // namespace vitruvia::scape_regression
