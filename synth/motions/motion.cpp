#include "synth/motions/motion.h"

#include <algorithm>
#include <stdexcept>

#include "core/error.h"
#include "math/angles.h"
#include "math/rotation.h"
#include "synth/motions/bvh.h"
#include "synth/motions/keyframes.h"
#include "synth/motions/mocap_retarget.h"
#include "synth/motions/smooth_step.h"

namespace vitruvia {
namespace {

// The subject stands in the rest pose, blends into the motion's pose at start_s, and then follows
// the motion. The motion is shifted and rotated on the floor so that the pelvis starts where it was
// in the rest pose; the rest pose itself always faces the front.
class MotionAfterRest final : public Motion {
 public:
  MotionAfterRest(std::unique_ptr<Motion> motion, const MotionSettings& settings,
                  const Skeleton& skeleton)
      : motion_(std::move(motion)),
        settings_(settings),
        rest_(JointPose::Rest(skeleton)),
        heading_(ExpSo3<double>(Vector3<double>(0, kRadiansPerDegree * settings.heading_deg, 0))),
        start_position_(motion_->At(settings.start_s).pose.pelvis_position),
        first_(Placed(motion_->At(settings.start_s))) {}

  double duration_s() const override {
    return LeadIn_s() + (motion_->duration_s() - settings_.start_s) / settings_.speed;
  }

  bool repeats() const override { return motion_->repeats(); }
  std::vector<std::string> warnings() const override { return motion_->warnings(); }

  MotionSample At(double time_s) const override {
    if (time_s >= LeadIn_s()) {
      return Placed(motion_->At(settings_.start_s + settings_.speed * (time_s - LeadIn_s())));
    }
    const double blending_s = std::max(time_s - settings_.rest_s, 0.0);
    return BetweenRestAndFirst(blending_s > 0.0 ? SmoothStep(blending_s / settings_.blend_s) : 0.0);
  }

 private:
  double LeadIn_s() const { return settings_.rest_s + settings_.blend_s; }

  MotionSample Placed(MotionSample sample) const {
    Vector3<double> from_start = sample.pose.pelvis_position - start_position_;
    from_start.y() = 0.0;
    const double height = sample.pose.pelvis_position.y();
    sample.pose.pelvis_position = rest_.pelvis_position + heading_ * from_start;
    sample.pose.pelvis_position.y() = height;
    sample.pose.local_rotations[0] = heading_ * sample.pose.local_rotations[0];
    return sample;
  }

  MotionSample BetweenRestAndFirst(double share) const {
    MotionSample sample = first_;
    for (std::size_t i = 0; i < kBoneCount; ++i) {
      const Eigen::Quaterniond rest(rest_.local_rotations[i]),
          first(first_.pose.local_rotations[i]);
      sample.pose.local_rotations[i] = rest.slerp(share, first).toRotationMatrix();
    }
    sample.pose.pelvis_position =
        (1.0 - share) * rest_.pelvis_position + share * first_.pose.pelvis_position;
    sample.clearance_m = share * first_.clearance_m;
    return sample;
  }

  std::unique_ptr<Motion> motion_;
  MotionSettings settings_;
  JointPose rest_;
  Matrix3<double> heading_;
  Vector3<double> start_position_;
  MotionSample first_;
};

std::unique_ptr<Motion> LoadFile(const MotionSettings& settings, const Skeleton& skeleton) {
  switch (settings.source) {
    case MotionSource::kKeyframes:
      return MakeKeyframedMotion(ReadKeyframes(settings.file), skeleton);
    case MotionSource::kCmu:
    case MotionSource::kBvh:
      return Retarget(LoadPerformer(settings, skeleton), skeleton);
  }
  throw std::logic_error("unknown motion source");
}

}  // namespace

void MotionSettings::Describe(Fields& f) {
  f.Choice(
      "source", source,
      {{"keyframes", MotionSource::kKeyframes},
       {"cmu", MotionSource::kCmu},
       {"bvh", MotionSource::kBvh}},
      {.meaning = "kind of file: key frames (.json), CMU motion capture (.amc) or BVH (.bvh)"});
  f.File("file", file, {.meaning = "the motion", .required = true});
  if (f.Applies(source == MotionSource::kCmu)) {
    f.File("skeleton", skeleton, {.meaning = "the .asf file of the .amc", .required = true});
    f.Visit(amc);
  }
  if (f.Applies(source != MotionSource::kKeyframes)) f.Visit(mocap);
  f.Number("start_s", start_s,
           {.meaning = "time in the motion at which the sequence begins", .unit = "s", .min = 0.0});
  f.Number("speed", speed, {.meaning = "playback rate", .min = 0.01, .max = 100.0});
  f.Number("rest_s", rest_s,
           {.meaning = "time for which the subject first stands in the T-pose",
            .unit = "s",
            .min = 0.0});
  f.Number("blend_s", blend_s,
           {.meaning = "duration of the transition from the T-pose to the motion's first pose",
            .unit = "s",
            .min = 0.0});
  f.Number("heading_deg", heading_deg,
           {.meaning = "rotation of the motion about the vertical axis through its start, to the "
                       "subject's left; the T-pose before it still faces the front",
            .unit = "deg",
            .min = -360.0,
            .max = 360.0});
}

MocapPerformer LoadPerformer(const MotionSettings& settings, const Skeleton& skeleton) {
  Require(settings.source != MotionSource::kKeyframes, "{}: key frames have no performer",
          settings.file.string());
  MocapClip clip = settings.source == MotionSource::kBvh
                       ? ReadBvh(settings.file)
                       : ReadAsfAmc(settings.file, settings.skeleton, settings.amc);
  return Understand(std::move(clip), settings.mocap, skeleton);
}

std::unique_ptr<Motion> LoadMotion(const MotionSettings& settings, const Skeleton& skeleton) {
  std::unique_ptr<Motion> motion = LoadFile(settings, skeleton);
  if (settings.start_s > motion->duration_s()) {
    throw ConfigError(fmt::format("{}: start_s: expected at most the motion's {:g} s, got {:g} s",
                                  settings.file.string(), motion->duration_s(), settings.start_s));
  }
  return std::make_unique<MotionAfterRest>(std::move(motion), settings, skeleton);
}

}  // namespace vitruvia
