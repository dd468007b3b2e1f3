#include "synth/scene/recording.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>

#include "config/json_settings.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/message.h"
#include "core/one_ahead.h"
#include "core/progress.h"
#include "geometry/surface_map.h"
#include "math/rigid.h"
#include "sequence/joint_visibility.h"
#include "sequence/sequence.h"
#include "sequence/view_watch.h"
#include "synth/scene/scene_warnings.h"
#include "synth/scene/stage.h"

namespace vitruvia {
namespace {

// Distance of the template, moved by the true bones, from the true surface: the error of a tracker
// that finds the true pose.
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

// Differences between the generator and a tracker's model, which are needed to interpret scores.
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

// A frame on its way from the stage to the sequence.
struct TakenFrame {
  DepthImage measured;
  std::vector<Vector3f> vertices;
  JointTruth joints;
  std::optional<MaskImage> mask;

  void WriteTo(SequenceWriter& writer, int frame) const {
    writer.Append(measured, vertices, joints);
    if (mask) writer.WriteMask(frame, *mask);
  }
};

}  // namespace

void RecordSequence(const SceneSettings& settings, const BodyModel& truth, const BodyModel& subject,
                    const Motion& motion, const std::filesystem::path& folder) {
  const PinholeCamera& camera = settings.view.camera;
  SequenceWriter writer(folder, Info(settings, truth, subject), subject, truth.rest);
  Stage stage(settings, truth, motion);
  OtherCameras others(settings, truth, motion);
  const StageSensor sensor(settings);
  ViewWatch watch(camera);
  TemplateMisfit misfit(subject, truth);
  {
    Progress progress("synth " + folder.filename().string(), settings.frames);
    const auto take = [&](int frame) {
      const double time_s = frame / settings.fps;
      TruePose posed = stage.PosedAt(time_s);
      RequireInRange(posed.vertices, frame, "view.position_m");
      watch.Look(posed.vertices, frame);
      misfit.Add(posed);
      const DepthImage true_depth = stage.Rendered(time_s, posed);
      TakenFrame taken;
      taken.joints = {posed.joints, VisibleJoints(posed.joints, true_depth, camera)};
      taken.measured = sensor.Measured(frame, time_s, true_depth, stage);
      if (settings.room.IsThere()) taken.mask = stage.BodyMask(posed, true_depth);
      taken.vertices = std::move(posed.vertices);
      others.Record(frame, time_s, writer);
      return taken;
    };
    MakeOneAhead(settings.frames, take, [&](int frame, const TakenFrame& taken) {
      taken.WriteTo(writer, frame);
      progress.Advance();
    });
  }
  if (settings.room.IsThere()) RecordEmptyRoom(settings, stage.room(), writer);
  writer.Note("template_moved_by_true_bones", misfit.Summary());
  std::vector<std::string> warnings = SceneWarnings(settings, motion, stage);
  const std::string out_of_view = watch.Warning(settings.frames);
  if (!out_of_view.empty()) warnings.push_back(out_of_view);
  for (const std::string& warning : warnings) PrintMessage("warning: {}\n", warning);
  if (!warnings.empty()) writer.Note("warnings", warnings);
  writer.Finish();
}

}  // namespace vitruvia
