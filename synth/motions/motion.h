// Motions: joint poses over time, from key frames or motion capture, for any body.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "body/skeleton.h"
#include "config/settings.h"
#include "synth/motions/asf_amc.h"
#include "synth/motions/mocap_performer.h"

namespace vitruvia {

enum class MotionSource { kKeyframes, kCmu, kBvh };

struct MotionSettings {
  MotionSource source = MotionSource::kKeyframes;
  std::filesystem::path file;      // .json, .amc or .bvh
  std::filesystem::path skeleton;  // .asf, cmu only
  AmcSettings amc;                 // cmu only
  MocapSettings mocap;             // cmu and bvh
  double start_s = 0.0;            // time in the motion at which the sequence begins
  double speed = 1.0;              // playback rate
  double rest_s = 0.5;             // the subject stands in the T-pose that long, first
  double blend_s = 0.7;            // and takes that long from the T-pose to the motion's first pose
  double heading_deg = 0.0;        // turns the whole motion about the vertical

  void Describe(Fields& fields);
};

struct MotionSample {
  JointPose pose;
  // Vertical position of the body. true: its lowest surface point is clearance_m above the floor;
  // false: pelvis_position is used unchanged.
  bool grounded = true;
  double clearance_m = 0.0;
};

class Motion {
 public:
  virtual ~Motion() = default;
  virtual MotionSample At(double time_s) const = 0;  // 0 … duration; held at the ends, or looped
  virtual double duration_s() const = 0;
  virtual bool repeats() const {
    return false;
  }  // true: repeats for ever; false: the last pose is
     // held
  // Doubts about its file: whole sentences that name the file.
  virtual std::vector<std::string> warnings() const { return {}; }
};

// Interprets a motion capture file for a body; std::invalid_argument if the source is key frames.
MocapPerformer LoadPerformer(const MotionSettings& settings, const Skeleton& skeleton);

// The motion retargeted to a body, with the T-pose lead-in of the settings. DataError / ConfigError
// naming the file and line on damaged files, unknown joints or angles beyond a joint's limits.
std::unique_ptr<Motion> LoadMotion(const MotionSettings& settings, const Skeleton& skeleton);

}  // namespace vitruvia
