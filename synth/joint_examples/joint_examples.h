// Depth images with known joints, for training a joint detector: people of a population in random
// poses (not from motion files), seen from the front.
#pragma once

#include <array>
#include <vector>

#include "config/settings.h"
#include "learning/joints/learn_joints.h"
#include "synth/population/population.h"
#include "synth/sensor/sensor.h"

namespace vitruvia {

struct RandomPoseSettings {
  double limits_used = 0.9;
  double calm_share = 0.5;
  double trunk_clearance_m = 0.16;
  double leg_clearance_m = 0.12;
  double heading_deviation_deg = 30.0;
  double tilt_deviation_deg = 8.0;

  void Describe(Fields& fields);
};

struct JointExampleSettings {
  PopulationSettings population;
  RefinementSettings mesh;
  int weight_diffusion = 4;
  int images = 12000;
  RandomPoseSettings poses;
  PinholeCamera camera;
  std::array<double, 2> distance_m{1.8, 3.6};
  std::array<double, 2> camera_height_m{0.8, 1.4};
  double off_centre_m = 0.3;
  SensorSettings sensor;
  double ideal_share = 0.5;
  int seed = 1;

  JointExampleSettings();
  void Describe(Fields& fields);
  std::string Problem() const;
};

// A pose of a skeleton in the subject frame, its limbs clear of its trunk and of each other; some
// joints are near the standing pose, others anywhere within their limits.
JointPose DrawClearPose(const RandomPoseSettings& settings, const Skeleton& skeleton,
                        RandomStream& random);

// The same settings give the same examples for any number of threads.
std::vector<joints::JointExample> MakeJointExamples(const JointExampleSettings& settings,
                                                    int threads);

}  // namespace vitruvia
