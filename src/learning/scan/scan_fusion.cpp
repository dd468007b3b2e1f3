#include "learning/scan/scan_fusion.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "core/timer.h"
#include "math/angles.h"
#include "math/rigid.h"
#include "math/rotation.h"

namespace vitruvia {
namespace {

constexpr double kShortEdge = 0.05;  // share of a voxel: shorter edges give sliver triangles

Vector3d MiddleOf(const VolumeSettings& volume) {
  Vector3d middle;
  for (int axis = 0; axis < 3; ++axis) {
    middle[axis] = 0.5 * (volume.low_m[axis] + volume.high_m[axis]);
  }
  return middle;
}

int SurfacePixels(const PointMap& map) {
  return static_cast<int>(
      std::count_if(map.normals.pixels().begin(), map.normals.pixels().end(),
                    [](const Vector3f& normal) { return normal != Vector3f::Zero(); }));
}

}  // namespace

ScanFusion::ScanFusion(const ScanFusionSettings& settings, const PinholeCamera& camera,
                       const Rigidd& subject_from_first_camera)
    : settings_(settings),
      camera_(camera),
      center_(MiddleOf(settings.volume)),
      volume_(settings.volume),
      subject_from_camera_(subject_from_first_camera),
      team_(std::make_unique<WorkerTeam>(settings.threads)) {}

std::vector<PointMap> ScanFusion::Pyramid(const DepthImage& depth) const {
  const double jump_m = settings_.volume.depth_jump_m;
  DepthImage level_depth = depth;
  DepthImage smooth_depth = Smoothed(depth, settings_.smoothing, *team_);
  PinholeCamera camera = camera_;
  std::vector<PointMap> pyramid;
  for (std::size_t level = 0; level < settings_.alignment.iterations.size(); ++level) {
    if (level > 0) {
      level_depth = Halved(level_depth, jump_m);
      smooth_depth = Halved(smooth_depth, jump_m);
      camera = Halved(camera);
    }
    pyramid.push_back(MakePointMap(level_depth, smooth_depth, camera, jump_m, *team_));
  }
  return pyramid;
}

std::string ScanFusion::ReasonForLoss(const AlignmentResult& result) const {
  const LossSettings& loss = settings_.loss;
  if (!(result.matched_share >= loss.min_matched_share)) {
    return fmt::format("{:.0f} % of its points match the model, expected at least {:.0f} %",
                       100.0 * result.matched_share, 100.0 * loss.min_matched_share);
  }
  if (!(result.condition <= loss.max_condition)) {
    return fmt::format(
        "its view does not tell where the camera is: condition number {:.2g}, expected at most "
        "{:.2g}",
        result.condition, loss.max_condition);
  }
  if (!(result.rms_m <= loss.max_rms_m)) {
    return fmt::format("it lies {:.1f} mm (rms) off the model, expected at most {:.1f} mm",
                       1e3 * result.rms_m, 1e3 * loss.max_rms_m);
  }
  const Rigidd step = Inverse(subject_from_camera_) * result.subject_from_camera;
  const double angle_deg = LogSo3<double>(step.rotation).norm() / kRadiansPerDegree;
  const double max_step_m = settings_.stride * loss.max_step_m;
  const double max_step_deg = settings_.stride * loss.max_step_deg;
  if (!(step.translation.norm() <= max_step_m && angle_deg <= max_step_deg)) {
    return fmt::format(
        "the camera seems to have moved {:.3f} m and turned {:.1f}° since the frame before, "
        "expected at most {:g} m and {:g}°",
        step.translation.norm(), angle_deg, max_step_m, max_step_deg);
  }
  return "";
}

FusedFrame ScanFusion::FuseFrame(const DepthImage& depth) {
  Require(depth.width() == camera_.width && depth.height() == camera_.height,
          "ScanFusion: a frame of {}×{} pixels, expected {}×{}", depth.width(), depth.height(),
          camera_.width, camera_.height);
  FusedFrame fused;
  fused.subject_from_camera = subject_from_camera_;
  Stopwatch watch;
  const auto lap = [&](ScanStep step) {
    fused.step_ms[static_cast<std::size_t>(step)] = watch.LapMs();
  };
  const std::vector<PointMap> pyramid = Pyramid(depth);
  lap(ScanStep::kPrepare);
  if (SurfacePixels(pyramid.front()) == 0) {
    fused.outcome = FrameOutcome::kEmpty;
    fused.message = "it has no depth";
    return fused;
  }
  if (!model_.surface.points.empty()) {
    const AlignmentResult result =
        Align(pyramid, model_, subject_from_camera_, center_, settings_.alignment, *team_);
    fused.matched_share = result.matched_share;
    fused.rms_m = result.rms_m;
    fused.condition = result.condition;
    fused.iterations = result.iterations;
    lap(ScanStep::kAlign);
    fused.message = ReasonForLoss(result);
    if (!fused.message.empty()) {
      fused.outcome = FrameOutcome::kLost;
      return fused;
    }
    subject_from_camera_ = result.subject_from_camera;
    fused.subject_from_camera = subject_from_camera_;
  }
  volume_.Integrate(depth, pyramid.front(), camera_, subject_from_camera_, *team_);
  lap(ScanStep::kIntegrate);
  model_ = {volume_.Raycast(camera_, subject_from_camera_, *team_), camera_,
            Inverse(subject_from_camera_)};
  lap(ScanStep::kRaycast);
  return fused;
}

ScanSurface ScanFusion::Surface() const {
  const double min_weight = settings_.surface.min_weight / settings_.stride;
  return Cleaned(ExtractSurface(volume_, min_weight), kShortEdge * settings_.volume.voxel_m,
                 settings_.surface.island_share);
}

}  // namespace vitruvia
