#include "synth/scene/stage.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "core/error.h"
#include "core/random.h"
#include "math/rigid.h"

namespace vitruvia {
namespace {

// Both as one camera sees them: what is nearer hides the other.
void PutBehind(const DepthImage& room, DepthImage& depth) {
  for (std::size_t i = 0; i < depth.pixels().size(); ++i) {
    const float behind = room.pixels()[i];
    float& z = depth.pixels()[i];
    if (z == 0.0f || (behind > 0.0f && behind < z)) z = behind;
  }
}

}  // namespace

void RequireInRange(const std::vector<Vector3f>& vertices_in_camera, int frame,
                    const char* setting) {
  for (const Vector3f& p : vertices_in_camera) {
    if (p.z() >= kNearest_m && p.z() <= kFarthest_m) continue;
    throw ConfigError(fmt::format(
        "{}: in frame {} a part of the body is {:.2f} m in front of the camera; expected {:g} … "
        "{:g} m",
        setting, frame, p.z(), kNearest_m, kFarthest_m));
  }
}

TruePose Pose(const BodyModel& body, const MotionSample& sample, Skinning skinning,
              const Rigidd& camera_from_subject) {
  const BoneTransforms bones = ForwardKinematics(body.skeleton, sample.pose);
  TruePose posed;
  if (skinning == Skinning::kLinear) {
    SkinLinear(body.rest.vertices, body.weights, bones, posed.vertices);
  } else {
    SkinDualQuaternion(body.rest.vertices, body.weights, bones, posed.vertices);
  }
  posed.joints = PosedJoints(body.skeleton, bones);

  double lift = 0.0;
  if (sample.grounded) {
    float lowest = std::numeric_limits<float>::infinity();
    for (const Vector3f& p : posed.vertices) lowest = std::min(lowest, p.y());
    lift = sample.clearance_m - lowest;
  }
  const Rigidd camera_from_posed =
      camera_from_subject * Rigidd{Matrix3<double>::Identity(), {0.0, lift, 0.0}};
  for (Vector3f& p : posed.vertices) {
    p = (camera_from_posed * p.cast<double>().eval()).cast<float>();
  }
  for (Vector3d& p : posed.joints) p = camera_from_posed * p;
  for (const Rigidd& posed_from_rest : bones) {
    posed.camera_from_rest.push_back(camera_from_posed * posed_from_rest);
  }
  return posed;
}

Stage::Stage(const SceneSettings& settings, const BodyModel& truth, const Motion& motion)
    : settings_(settings),
      motion_(motion),
      camera_from_subject_(CameraFromSubject(settings.view)),
      garment_(truth, settings.truth.cloth, static_cast<std::uint64_t>(settings.seed)),
      dressed_(truth),
      renderer_(settings.view.camera, kNearest_m, kFarthest_m) {
  if (!settings.room.IsThere()) return;
  const TriangleMesh room = RoomMesh(settings.room, camera_from_subject_);
  room_ = renderer_.Render(room.vertices, room.triangles);
}

TruePose Stage::PosedAt(double time_s) {
  const MotionSample sample = motion_.At(time_s);
  if (!settings_.truth.cloth.IsBare()) {
    garment_.Dress(sample.pose, time_s, dressed_.rest.vertices);
  }
  return Pose(dressed_, sample, settings_.truth.skinning, camera_from_subject_);
}

DepthImage Stage::Rendered(double time_s, const TruePose& body) {
  TriangleMesh seen{body.vertices, dressed_.rest.triangles};
  AddOccluder(time_s, seen);
  AddCarried(settings_.carried, time_s, dressed_.skeleton, body.camera_from_rest, seen);
  DepthImage depth = renderer_.Render(seen.vertices, seen.triangles);
  if (!room_.empty()) PutBehind(room_, depth);
  return depth;
}

void Stage::AddOccluder(double time_s, TriangleMesh& seen) const {
  const OccluderSettings& occluder = settings_.occluder;
  if (!occluder.IsThere() || !occluder.presence.Holds(time_s)) return;
  if (occluder.shape == OccluderShape::kPost)
    return AddPost(occluder, time_s, camera_from_subject_, seen);
  const auto [x, z] = PositionAt(occluder, time_s);
  const Rigidd camera_from_person =
      camera_from_subject_ * Rigidd{Matrix3<double>::Identity(), {x, 0.0, z}};
  const TruePose person = Pose(dressed_, motion_.At(time_s + occluder.later_s),
                               settings_.truth.skinning, camera_from_person);
  AppendSurface(person.vertices, dressed_.rest.triangles, seen);
}

DepthImage Stage::RenderedAlone(const TruePose& body) {
  return renderer_.Render(body.vertices, dressed_.rest.triangles);
}

MaskImage Stage::BodyMask(const TruePose& body, const DepthImage& depth) {
  const DepthImage alone = RenderedAlone(body);
  MaskImage mask(depth.width(), depth.height());
  for (std::size_t i = 0; i < mask.pixels().size(); ++i) {
    const float z = alone.pixels()[i];
    mask.pixels()[i] = z > 0.0f && z <= depth.pixels()[i] ? 255 : 0;
  }
  return mask;
}

StageSensor::StageSensor(const SceneSettings& settings)
    : settings_(settings),
      seed_(static_cast<std::uint64_t>(settings.seed)),
      lost_(LostFrames(settings.sensor.delivery, settings.frames, seed_)) {}

DepthImage StageSensor::Measured(int frame, double time_s, const DepthImage& true_depth,
                                 Stage& stage) const {
  const PinholeCamera& camera = settings_.view.camera;
  if (lost_[frame]) return DepthImage(camera.width, camera.height);
  RandomStream noise(seed_, fmt::format("sensor/{}", frame));
  const double capture_time_s = CaptureTime(settings_.sensor.delivery, time_s);
  const DepthImage captured = capture_time_s == time_s
                                  ? true_depth
                                  : stage.Rendered(capture_time_s, stage.PosedAt(capture_time_s));
  return Measure(captured, camera, settings_.sensor, noise);
}

}  // namespace vitruvia
