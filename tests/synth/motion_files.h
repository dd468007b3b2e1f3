// Motions written for a test, and where they put a body's joints.
#pragma once

#include <fstream>
#include <string>

#include "core/error.h"
#include "math/rigid.h"
#include "support/temporary_folder.h"
#include "support/tiny_body.h"
#include "synth/motions/motion.h"

namespace vitruvia {

inline const Skeleton& TestSkeleton() {
  static const Skeleton skeleton = TinyBody().skeleton;
  return skeleton;
}

// The motion of a file with this content, without a lead-in.
inline std::unique_ptr<Motion> MotionOf(const std::string& json) {
  const TemporaryFolder folder;
  std::ofstream(folder / "motion.json") << json;
  MotionSettings settings;
  settings.file = folder / "motion.json";
  settings.rest_s = settings.blend_s = 0.0;
  return LoadMotion(settings, TestSkeleton());
}

// A motion of one key frame with these angles.
inline std::unique_ptr<Motion> StillOf(const std::string& angles) {
  return MotionOf(R"({"keyframes": [{"time_s": 0, "angles": {)" + angles + "}}]}");
}

// What is said of a file with this content; its folder is left out.
inline std::string ProblemOf(const std::string& json) {
  const TemporaryFolder folder;
  std::ofstream(folder / "motion.json") << json;
  MotionSettings settings;
  settings.file = folder / "motion.json";
  try {
    LoadMotion(settings, TestSkeleton());
  } catch (const ConfigError& error) {
    const std::string message = error.what(), prefix = folder.path().string() + "/";
    return message.substr(0, prefix.size()) == prefix ? message.substr(prefix.size()) : message;
  }
  return "no error";
}

// Where a motion has the bones' near and far ends at a time.
struct PosedBones {
  std::vector<Vector3<double>> joints, tips;

  PosedBones(const Motion& motion, double time_s) {
    const BoneTransforms bones = ForwardKinematics(TestSkeleton(), motion.At(time_s).pose);
    joints = PosedJoints(TestSkeleton(), bones);
    for (int bone = 0; bone < kBoneCount; ++bone) {
      tips.push_back(bones[static_cast<std::size_t>(bone)] *
                     TestSkeleton().tips[static_cast<std::size_t>(bone)]);
    }
  }
  const Vector3<double>& Joint(BoneId bone) const { return joints[static_cast<std::size_t>(bone)]; }
  const Vector3<double>& Tip(BoneId bone) const { return tips[static_cast<std::size_t>(bone)]; }
};

}  // namespace vitruvia
