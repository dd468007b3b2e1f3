// The scene of a scan: the camera moves round a subject that tries to stand still in the T-pose.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/settings.h"
#include "geometry/camera.h"
#include "synth/bodies/body_source.h"
#include "synth/scene/scene.h"
#include "synth/sensor/sensor.h"

namespace vitruvia {

// The camera moves about the vertical axis through the subject, and up and down.
struct CameraPathSettings {
  double start_deg = 0.0;
  double radius_m = 1.9;
  double turns = 2.0;
  std::array<double, 2> heights_m{0.5, 2.1};
  std::array<double, 2> look_at_heights_m{0.75, 1.05};
  double height_cycles = 3.5;
  double jitter_m = 0.005;
  double jitter_deg = 0.3;

  void Describe(Fields& fields);
  std::string Problem() const;
};

// How the subject stands. At the first frame it does not sway.
struct StanceSettings {
  double arms_lowered_deg = 0.0;
  double sway_deg = 0.0;
  double arm_sway_deg = 0.0;
  double sway_period_s = 4.0;

  void Describe(Fields& fields);
};

struct BystanderSettings {
  std::array<double, 2> place_m{0.0, -0.6};

  void Describe(Fields& fields);
};

struct ScanSceneSettings {
  BodySettings body;
  TruthSettings truth;  // the surface that is rendered
  StanceSettings stance;
  std::vector<BystanderSettings> bystanders;
  PinholeCamera camera;
  CameraPathSettings path;
  SensorSettings sensor;
  int frames = 900;
  double fps = 30.0;
  int seed = 1;

  void Describe(Fields& fields);
  std::string Problem() const;
};

}  // namespace vitruvia
