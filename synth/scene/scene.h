// A scene: person, motion and camera, and the differences between the true surface and the
// tracker's model.
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "config/settings.h"
#include "geometry/camera.h"
#include "synth/bodies/body_source.h"
#include "synth/cloth/garment.h"
#include "synth/motions/motion.h"
#include "synth/scene/carried.h"
#include "synth/scene/occluder.h"
#include "synth/scene/room.h"
#include "synth/sensor/sensor.h"

namespace vitruvia {

enum class Skinning { kLinear, kDualQuaternion };

struct TruthSettings {
  Skinning skinning = Skinning::kLinear;
  RefinementSettings refinement;
  ClothSettings cloth;  // none by default

  void Describe(Fields& fields);
};

struct ViewSettings {
  PinholeCamera camera;
  std::array<double, 3> position_m{
      0.0, 1.0, 2.8};  // subject frame's axes, origin on the floor under the start
  std::array<double, 3> look_at_m{0.0, 0.95, 0.0};
  double roll_deg = 0.0;  // about the line of sight, the camera clockwise as it sees it

  void Describe(Fields& fields);
  std::string Problem() const;
};

// The camera that looks from position_m at look_at_m: upright, then rolled.
Rigidd CameraFromSubject(const ViewSettings& view);

// Another camera that records the same scene.
struct OtherViewSettings {
  std::string name;
  ViewSettings view;

  void Describe(Fields& fields);
};

struct SceneSettings {
  std::string title;
  BodySettings body;
  MotionSettings motion;
  TruthSettings truth;         // the surface that is rendered
  RefinementSettings subject;  // the template that a tracker is given
  ViewSettings view;
  std::vector<OtherViewSettings> views;  // of other cameras, which no tracker sees
  OccluderSettings occluder;             // none by default
  CarriedSettings carried;               // nothing by default
  RoomSettings room;                     // none by default; with one the true mask is written
  SensorSettings sensor;
  int frames = 300;
  double fps = 30.0;
  int seed = 1;

  void Describe(Fields& fields);
  std::string Problem() const;
};

// Renders the scene and writes the sequence (sequence/sequence.h). Same settings: same bytes.
// ConfigError if the body leaves the renderer's depth range.
void SynthesizeSequence(const SceneSettings& settings, const std::filesystem::path& folder);

}  // namespace vitruvia
