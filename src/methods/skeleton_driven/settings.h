// Settings of the skeleton-driven baseline (paper A, figure 9).
#pragma once

#include <filesystem>
#include <string>

#include "config/settings.h"
#include "learning/joints/joint_model.h"
#include "learning/skinning/heat_weights.h"
#include "methods/skeleton_driven/inverse_kinematics.h"

namespace vitruvia::skeleton_driven {

// Who finds the joints.
enum class JointSource {
  kDetector,  // a model learnt from synthetic depth (learning/joints), in each frame anew
  kFile,      // a file of observations: of another detector, or of a stand-in for one
};

struct DetectorSettings {
  std::filesystem::path model;  // folder
  joints::VoteSettings votes;

  void Describe(Fields& fields);
};

struct Settings {
  JointSource joints = JointSource::kDetector;
  DetectorSettings detector;           // of kDetector
  std::filesystem::path observations;  // of kFile
  InverseKinematicsSettings pose;
  skinning::HeatWeightSettings weights;
  double max_depth_m = 8.0;
  double lost_above_m = 0.1;

  void Describe(Fields& fields);
  std::string Problem() const;
};

}  // namespace vitruvia::skeleton_driven
