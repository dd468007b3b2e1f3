#include "synth/scan/scan_recorder.h"

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "math/angles.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "synth/render/depth_renderer.h"
#include "synth/scene/stage.h"

namespace vitruvia {
namespace {

// Periods of the sway relative to the first one: so that no two ever meet again.
constexpr double kSidewaysPeriod = 1.618, kLeftArmPeriod = 0.786, kRightArmPeriod = 1.272;

Matrix3<double> Turn(double angle_deg, const Vector3d& axis) {
  return ExpSo3<double>(angle_deg * kRadiansPerDegree * axis);
}

double Wave(double time_s, double period_s) {
  return std::sin(2.0 * std::numbers::pi * time_s / period_s);
}

JointPose StandingPose(const Skeleton& skeleton, const StanceSettings& stance, double time_s) {
  JointPose pose = JointPose::Rest(skeleton);
  const auto local = [&pose](BoneId bone) -> Matrix3<double>& {
    return pose.local_rotations[static_cast<std::size_t>(bone)];
  };
  const double period_s = stance.sway_period_s;
  const Matrix3<double> lean =
      Turn(stance.sway_deg * Wave(time_s, period_s), Vector3d::UnitX()) *
      Turn(stance.sway_deg * Wave(time_s, kSidewaysPeriod * period_s), Vector3d::UnitZ());
  const Vector3d ankles = 0.5 * (skeleton.joints[static_cast<std::size_t>(BoneId::kLeftFoot)] +
                                 skeleton.joints[static_cast<std::size_t>(BoneId::kRightFoot)]);
  local(BoneId::kPelvis) = lean;
  pose.pelvis_position = RotationAbout<double>(lean, ankles) * pose.pelvis_position;
  local(BoneId::kLeftFoot) = local(BoneId::kRightFoot) = lean.transpose();
  const double left_deg =
      stance.arms_lowered_deg + stance.arm_sway_deg * Wave(time_s, kLeftArmPeriod * period_s);
  const double right_deg =
      stance.arms_lowered_deg + stance.arm_sway_deg * Wave(time_s, kRightArmPeriod * period_s);
  local(BoneId::kLeftUpperArm) = Turn(-left_deg, Vector3d::UnitZ());
  local(BoneId::kRightUpperArm) = Turn(right_deg, Vector3d::UnitZ());
  return pose;
}

void Quantize(DepthImage& depth, double unit_m) {
  for (float& z : depth.pixels()) z = static_cast<float>(std::round(z / unit_m) * unit_m);
}

}  // namespace

// A hand's unsteadiness: for each coordinate a sum of a few waves.
struct ScanRecorder::Jitter {
  static constexpr int kWaves = 4, kCoordinates = 6;
  static constexpr double kSlowestHz = 0.3, kFastestHz = 2.0;

  struct Component {
    double hertz, phase;
  };
  std::array<std::array<Component, kWaves>, kCoordinates> components;

  explicit Jitter(int seed) {
    RandomStream random(static_cast<std::uint64_t>(seed), "scan/jitter");
    for (auto& waves : components) {
      for (Component& wave : waves) {
        wave.hertz = random.Uniform(kSlowestHz, kFastestHz);
        wave.phase = random.Uniform(0.0, 2.0 * std::numbers::pi);
      }
    }
  }

  // Of standard deviation 1.
  double At(int coordinate, double time_s) const {
    double sum = 0.0;
    for (const Component& wave : components[static_cast<std::size_t>(coordinate)]) {
      sum += std::sin(2.0 * std::numbers::pi * wave.hertz * time_s + wave.phase);
    }
    return sum * std::sqrt(2.0 / kWaves);
  }
};

ScanRecorder::ScanRecorder(const ScanSceneSettings& settings)
    : ScanRecorder(settings, Refine(MakeControlBody(settings.body), settings.truth.refinement)) {}

ScanRecorder::ScanRecorder(const ScanSceneSettings& settings, BodyModel person)
    : settings_(settings),
      body_(std::move(person)),
      jitter_(std::make_unique<Jitter>(settings.seed)),
      renderer_(std::make_unique<DepthRenderer>(settings.camera, kNearest_m, kFarthest_m)) {
  BoneTransforms bones;
  surface_ = {Stand(0.0, bones), body_.rest.triangles};
  chest_at_start_ = bones[static_cast<std::size_t>(BoneId::kChest)];
}

ScanRecorder::~ScanRecorder() = default;

std::vector<Vector3f> ScanRecorder::Stand(double time_s, BoneTransforms& bones) const {
  bones = ForwardKinematics(body_.skeleton, StandingPose(body_.skeleton, settings_.stance, time_s));
  std::vector<Vector3f> vertices;
  if (settings_.truth.skinning == Skinning::kLinear) {
    SkinLinear(body_.rest.vertices, body_.weights, bones, vertices);
  } else {
    SkinDualQuaternion(body_.rest.vertices, body_.weights, bones, vertices);
  }
  return vertices;
}

Rigidd ScanRecorder::CameraAt(int frame) const {
  const CameraPathSettings& path = settings_.path;
  const double share = settings_.frames > 1 ? frame / (settings_.frames - 1.0) : 0.0;
  const double time_s = frame / settings_.fps;
  const double azimuth = (path.start_deg + 360.0 * path.turns * share) * kRadiansPerDegree;
  const double up = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * path.height_cycles * share);
  const auto between = [up](const std::array<double, 2>& ends) {
    return ends[0] + up * (ends[1] - ends[0]);
  };
  ViewSettings view;
  view.position_m = {path.radius_m * std::sin(azimuth), between(path.heights_m),
                     path.radius_m * std::cos(azimuth)};
  view.look_at_m = {0.0, between(path.look_at_heights_m), 0.0};
  Vector3d shift, turn;
  for (int axis = 0; axis < 3; ++axis) {
    shift[axis] = path.jitter_m * jitter_->At(axis, time_s);
    turn[axis] = path.jitter_deg * kRadiansPerDegree * jitter_->At(3 + axis, time_s);
  }
  return Rigidd{ExpSo3<double>(turn), shift} * CameraFromSubject(view);
}

ScanFrame ScanRecorder::Render(int frame) {
  Require(frame >= 0 && frame < settings_.frames, "ScanRecorder: frame {} of {}", frame,
          settings_.frames);
  BoneTransforms bones;
  const std::vector<Vector3f> body = Stand(frame / settings_.fps, bones);
  const Rigidd camera_from_floor = CameraAt(frame);
  TriangleMesh seen;
  const auto add = [&](const Vector3d& place) {
    std::vector<Vector3f> vertices;
    for (const Vector3f& p : body) {
      vertices.push_back((camera_from_floor * (p.cast<double>() + place)).cast<float>());
    }
    AppendSurface(vertices, body_.rest.triangles, seen);
  };
  add(Vector3d::Zero());
  for (const BystanderSettings& b : settings_.bystanders) add({b.place_m[0], 0.0, b.place_m[1]});
  RequireInRange(seen.vertices, frame, "path");

  const DepthImage true_depth = renderer_->Render(seen.vertices, seen.triangles);
  RandomStream noise(static_cast<std::uint64_t>(settings_.seed), fmt::format("sensor/{}", frame));
  ScanFrame result;
  result.vertices.assign(seen.vertices.begin(),
                         seen.vertices.begin() + static_cast<std::ptrdiff_t>(body.size()));
  for (const Vector3d& joint : PosedJoints(body_.skeleton, bones)) {
    result.joints.push_back(camera_from_floor * joint);
  }
  result.depth = Measure(true_depth, settings_.camera, settings_.sensor, noise);
  Quantize(result.depth, settings_.sensor.depth_unit_m);
  result.camera_from_subject = camera_from_floor * bones[static_cast<std::size_t>(BoneId::kChest)] *
                               Inverse(chest_at_start_);
  return result;
}

}  // namespace vitruvia
