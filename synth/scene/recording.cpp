#include "synth/scene/recording.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

#include "config/json_settings.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/message.h"
#include "core/progress.h"
#include "geometry/surface_map.h"
#include "math/rigid.h"
#include "sequence/joint_visibility.h"
#include "sequence/sequence.h"
#include "sequence/view_watch.h"
#include "synth/cloth/garment.h"
#include "synth/render/depth_renderer.h"

namespace vitruvia {
namespace {

constexpr double kNearM = 0.2, kFarM = 12.0;  // of the renderer; the body must stay between them

// How far the template, moved by the true bones, is from the truth: what remains for a tracker that
// finds the true pose.
class TemplateMisfit {
 public:
  TemplateMisfit(const BodyModel& subject, const BodyModel& truth)
      : subject_(subject),
        truth_(truth),
        on_truth_(ClosestSurfacePoints(subject.rest.vertices, truth.rest)) {}

  void Add(const TruePose& posed_truth) {
    SkinLinear(subject_.rest.vertices, subject_.weights, posed_truth.camera_from_rest, posed_);
    for (std::size_t i = 0; i < posed_.size(); ++i) {
      const Vector3f target =
          Evaluate(on_truth_[i], posed_truth.vertices.data(), truth_.rest.triangles);
      const double distance_m = (posed_[i] - target).norm();
      sum_m_ += distance_m;
      max_m_ = std::max(max_m_, distance_m);
    }
    count_ += posed_.size();
  }

  Json Summary() const {
    return {{"l2_mean_m", sum_m_ / static_cast<double>(count_)}, {"l2_max_m", max_m_}};
  }

 private:
  const BodyModel& subject_;
  const BodyModel& truth_;
  std::vector<SurfacePoint> on_truth_;
  std::vector<Vector3f> posed_;
  double sum_m_ = 0.0, max_m_ = 0.0;
  std::size_t count_ = 0;
};

// "" for the ideal sensor.
std::string SensorDifference(const SensorSettings& sensor) {
  switch (sensor.model) {
    case SensorModel::kIdeal:
      return "";
    case SensorModel::kGaussian:
      return fmt::format("depth noise of {:g} m and dropout of {:g}", sensor.sigma_m,
                         sensor.dropout);
    case SensorModel::kKinectV1:
      return fmt::format("depth as structured light measures it, dropout of {:g}", sensor.dropout);
    case SensorModel::kKinectOne:
      return fmt::format("depth as time of flight measures it, dropout of {:g}", sensor.dropout);
  }
  return "";
}

// Where the generator and a tracker's model differ: a score says little without it.
std::vector<std::string> Differences(const SceneSettings& s, const BodyModel& truth,
                                     const BodyModel& subject) {
  std::vector<std::string> differences;
  if (s.truth.skinning == Skinning::kDualQuaternion) {
    differences.push_back("the truth is skinned with dual quaternions");
  }
  if (truth.rest.vertices.size() != subject.rest.vertices.size()) {
    differences.push_back(fmt::format("the true mesh has {} vertices, the template {}",
                                      truth.rest.vertices.size(), subject.rest.vertices.size()));
  }
  if (s.truth.refinement.weight_diffusion != s.subject.weight_diffusion) {
    differences.push_back(
        fmt::format("skinning weights diffused over {} steps in the truth, {} in the template",
                    s.truth.refinement.weight_diffusion, s.subject.weight_diffusion));
  }
  const ClothSettings& cloth = s.truth.cloth;
  if (!cloth.IsBare()) {
    differences.push_back(
        fmt::format("the truth wears cloth: volume {:g}, thickness {:g}, folds {:g}, wrinkles "
                    "{:g}, drape {:g} m",
                    cloth.volume_m, cloth.thickness_m, cloth.fold_depth_m, cloth.wrinkle_depth_m,
                    cloth.drape_m));
  }
  const std::string sensor = SensorDifference(s.sensor);
  if (!sensor.empty()) differences.push_back(sensor);
  return differences;
}

SequenceInfo Info(const SceneSettings& settings, const BodyModel& truth, const BodyModel& subject) {
  SequenceInfo info;
  info.camera = settings.view.camera;
  info.depth_unit_m = settings.sensor.depth_unit_m;
  info.fps = settings.fps;
  info.frames = settings.frames;
  for (const BoneInfo& bone : Bones()) info.joints.emplace_back(bone.joint);
  for (const OtherViewSettings& other : settings.views) {
    info.views.push_back(
        {other.name, other.view.camera,
         CameraFromSubject(other.view) * Inverse(CameraFromSubject(settings.view))});
  }
  info.provenance = {{"made_by", "vitruvia synth"},
                     {"scene", WriteSettings(settings)},
                     {"truth_differs_from_template", Differences(settings, truth, subject)},
                     {"build", Provenance()}};
  return info;
}

// The depth range is the renderer's: beyond it the surface would be cut open without a word.
void RequireInRange(const std::vector<Vector3f>& vertices_in_camera, int frame) {
  for (const Vector3f& p : vertices_in_camera) {
    if (p.z() >= kNearM && p.z() <= kFarM) continue;
    throw ConfigError(fmt::format(
        "view.position_m: in frame {} a part of the body is {:.2f} m in front of the camera; "
        "expected {:g} … {:g} m",
        frame, p.z(), kNearM, kFarM));
  }
}

// What somebody who reads the sequence should know: of the motion's file, and of a scene that goes
// on when its motion has ended.
std::vector<std::string> MotionWarnings(const SceneSettings& settings, const Motion& motion) {
  std::vector<std::string> warnings = motion.warnings();
  if (motion.repeats()) return warnings;
  int held = 0;
  for (int frame = 0; frame < settings.frames; ++frame) {
    held += frame / settings.fps > motion.duration_s() + 0.5 / settings.fps;
  }
  if (held > 0) {
    warnings.push_back(fmt::format(
        "{}: the motion ends after {:.2f} s, the scene's {} frames at {:g} frames/s take {:.2f} s: "
        "the last {} frames hold the last pose",
        settings.motion.file.string(), motion.duration_s(), settings.frames, settings.fps,
        settings.frames / settings.fps, held));
  }
  return warnings;
}

// Both as one camera sees them: what is nearer hides the other.
void PutBehind(const DepthImage& room, DepthImage& depth) {
  for (std::size_t i = 0; i < depth.pixels().size(); ++i) {
    const float behind = room.pixels()[i];
    float& z = depth.pixels()[i];
    if (z == 0.0f || (behind > 0.0f && behind < z)) z = behind;
  }
}

// The scene at any time: its body, dressed and posed, and what a camera without noise sees of it.
class Stage {
 public:
  Stage(const SceneSettings& settings, const BodyModel& truth, const Motion& motion)
      : settings_(settings),
        motion_(motion),
        camera_from_subject_(CameraFromSubject(settings.view)),
        garment_(truth, settings.truth.cloth, static_cast<std::uint64_t>(settings.seed)),
        dressed_(truth),
        renderer_(settings.view.camera, kNearM, kFarM) {
    if (!settings.room.IsThere()) return;
    const TriangleMesh room = RoomMesh(settings.room, camera_from_subject_);
    room_ = renderer_.Render(room.vertices, room.triangles);
  }

  TruePose PosedAt(double time_s) {
    const MotionSample sample = motion_.At(time_s);
    if (!settings_.truth.cloth.IsBare()) {
      garment_.Dress(sample.pose, time_s, dressed_.rest.vertices);
    }
    return Pose(dressed_, sample, settings_.truth.skinning, camera_from_subject_);
  }

  // Without a person; empty where the scene has no room.
  const DepthImage& room() const { return room_; }

  DepthImage Rendered(double time_s, const TruePose& body) {
    TriangleMesh seen{body.vertices, dressed_.rest.triangles};
    AddOccluder(settings_.occluder, time_s, camera_from_subject_, seen);
    DepthImage depth = renderer_.Render(seen.vertices, seen.triangles);
    if (!room_.empty()) PutBehind(room_, depth);
    return depth;
  }

  // Where `depth`, rendered at the same time, shows the body.
  MaskImage BodyMask(const TruePose& body, const DepthImage& depth) {
    const DepthImage alone = renderer_.Render(body.vertices, dressed_.rest.triangles);
    MaskImage mask(depth.width(), depth.height());
    for (std::size_t i = 0; i < mask.pixels().size(); ++i) {
      const float z = alone.pixels()[i];
      mask.pixels()[i] = z > 0.0f && z <= depth.pixels()[i] ? 255 : 0;
    }
    return mask;
  }

 private:
  const SceneSettings& settings_;
  const Motion& motion_;
  Rigidd camera_from_subject_;
  Garment garment_;
  BodyModel dressed_;  // its surface changes from frame to frame
  DepthRenderer renderer_;
  DepthImage room_;
};

// What the sensor delivers of a frame: perhaps late, with noise, or nothing.
class Sensor {
 public:
  explicit Sensor(const SceneSettings& settings)
      : settings_(settings),
        seed_(static_cast<std::uint64_t>(settings.seed)),
        lost_(LostFrames(settings.sensor.delivery, settings.frames, seed_)) {}

  DepthImage Measured(int frame, double time_s, const DepthImage& true_depth, Stage& stage) const {
    const PinholeCamera& camera = settings_.view.camera;
    if (lost_[frame]) return DepthImage(camera.width, camera.height);
    RandomStream noise(seed_, fmt::format("sensor/{}", frame));
    const double capture_time_s = CaptureTime(settings_.sensor.delivery, time_s);
    const DepthImage captured = capture_time_s == time_s
                                    ? true_depth
                                    : stage.Rendered(capture_time_s, stage.PosedAt(capture_time_s));
    return Measure(captured, camera, settings_.sensor, noise);
  }

 private:
  const SceneSettings& settings_;
  std::uint64_t seed_;
  std::vector<bool> lost_;
};

// What the other cameras measure. They stand elsewhere, so each has a stage of its own.
class OtherCameras {
 public:
  OtherCameras(const SceneSettings& settings, const BodyModel& truth, const Motion& motion) {
    for (const OtherViewSettings& other : settings.views) {
      scenes_.push_back(settings);
      scenes_.back().view = other.view;
    }
    for (const SceneSettings& scene : scenes_)
      stages_.push_back(std::make_unique<Stage>(scene, truth, motion));
  }

  // Only the body and what hides it, without the room: what the score compares is the body.
  void Record(int frame, double time_s, const SequenceWriter& writer) {
    for (std::size_t k = 0; k < stages_.size(); ++k) {
      const TruePose posed = stages_[k]->PosedAt(time_s);
      DepthImage depth = stages_[k]->Rendered(time_s, posed);
      const MaskImage mask = stages_[k]->BodyMask(posed, depth);
      for (std::size_t i = 0; i < mask.pixels().size(); ++i) {
        if (mask.pixels()[i] == 0) depth.pixels()[i] = 0.0f;
      }
      RandomStream noise(static_cast<std::uint64_t>(scenes_[k].seed),
                         fmt::format("sensor/views/{}/{}", k, frame));
      writer.WriteViewDepth(static_cast<int>(k), frame,
                            Measure(depth, scenes_[k].view.camera, scenes_[k].sensor, noise));
    }
  }

 private:
  std::vector<SceneSettings> scenes_;  // each seen from one of the other cameras
  std::vector<std::unique_ptr<Stage>> stages_;
};

// What the sensor measures of the room before anybody comes.
void RecordEmptyRoom(const SceneSettings& settings, const DepthImage& room,
                     const SequenceWriter& writer) {
  for (int i = 0; i < settings.room.empty_frames; ++i) {
    RandomStream noise(static_cast<std::uint64_t>(settings.seed),
                       fmt::format("sensor/empty_room/{}", i));
    writer.WriteEmptyRoom(i, Measure(room, settings.view.camera, settings.sensor, noise));
  }
}

}  // namespace

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

void RecordSequence(const SceneSettings& settings, const BodyModel& truth, const BodyModel& subject,
                    const Motion& motion, const std::filesystem::path& folder) {
  const PinholeCamera& camera = settings.view.camera;
  SequenceWriter writer(folder, Info(settings, truth, subject), subject, truth.rest);
  Stage stage(settings, truth, motion);
  OtherCameras others(settings, truth, motion);
  const Sensor sensor(settings);
  ViewWatch watch(camera);
  TemplateMisfit misfit(subject, truth);
  {
    Progress progress("synth " + folder.filename().string(), settings.frames);
    for (int frame = 0; frame < settings.frames; ++frame) {
      const double time_s = frame / settings.fps;
      const TruePose posed = stage.PosedAt(time_s);
      RequireInRange(posed.vertices, frame);
      watch.Look(posed.vertices, frame);
      misfit.Add(posed);
      const DepthImage true_depth = stage.Rendered(time_s, posed);
      const JointTruth joints{posed.joints, VisibleJoints(posed.joints, true_depth, camera)};
      const DepthImage measured = sensor.Measured(frame, time_s, true_depth, stage);
      writer.Append(measured, posed.vertices, joints);
      others.Record(frame, time_s, writer);
      if (settings.room.IsThere()) writer.WriteMask(frame, stage.BodyMask(posed, true_depth));
      progress.Advance();
    }
  }
  if (settings.room.IsThere()) RecordEmptyRoom(settings, stage.room(), writer);
  writer.Note("template_moved_by_true_bones", misfit.Summary());
  std::vector<std::string> warnings = MotionWarnings(settings, motion);
  const std::string out_of_view = watch.Warning(settings.frames);
  if (!out_of_view.empty()) warnings.push_back(out_of_view);
  for (const std::string& warning : warnings) PrintMessage("warning: {}\n", warning);
  if (!warnings.empty()) writer.Note("warnings", warnings);
  writer.Finish();
}

}  // namespace vitruvia
