#include "synth/motions/keyframes_pose.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace vitruvia {
namespace {

constexpr const char* kSideNames[kSideCount] = {"left", "right"};

// One joint's angles in a list of angles.
struct JointAngles {
  const JointInfo& joint;
  double* angles_deg;

  void Describe(Fields& f) {
    for (std::size_t i = 0; i < joint.angles.size(); ++i) {
      const AngleInfo& angle = joint.angles[i];
      f.Number(angle.key, angles_deg[static_cast<std::size_t>(joint.first) + i],
               {.meaning = angle.meaning,
                .unit = "deg",
                .min = angle.min_deg,
                .max = angle.max_deg,
                .source = angle.source});
    }
  }
};

void DescribeJoint(Fields& f, const std::string& name, const JointInfo& joint, double* angles_deg) {
  JointAngles angles{joint, angles_deg};
  f.Section(name.c_str(), angles, {.meaning = "joint angles"});
}

std::string SideName(int side, const JointInfo& joint) {
  return fmt::format("{}_{}", kSideNames[side], joint.name);
}

}  // namespace

MentionedAngles::MentionedAngles() {
  constexpr double kNotMentioned = std::numeric_limits<double>::quiet_NaN();
  midline_deg.fill(kNotMentioned);
  for (auto& side : sides_deg) side.fill(kNotMentioned);
  both_sides_deg.fill(kNotMentioned);
}

void MentionedAngles::Describe(Fields& f) {
  for (const JointInfo& joint : MidlineJoints()) {
    DescribeJoint(f, joint.name, joint, midline_deg.data());
  }
  for (const JointInfo& joint : SideJoints()) {
    DescribeJoint(f, joint.plural, joint, both_sides_deg.data());
    for (int side = 0; side < kSideCount; ++side) {
      DescribeJoint(f, SideName(side, joint), joint,
                    sides_deg[static_cast<std::size_t>(side)].data());
    }
  }
}

std::string MentionedAngles::Problem() const {
  for (const JointInfo& joint : SideJoints()) {
    for (std::size_t i = 0; i < joint.angles.size(); ++i) {
      const std::size_t angle = static_cast<std::size_t>(joint.first) + i;
      if (std::isnan(both_sides_deg[angle])) continue;
      for (int side = 0; side < kSideCount; ++side) {
        if (std::isnan(sides_deg[static_cast<std::size_t>(side)][angle])) continue;
        return fmt::format("{0} of the {1} is given twice: by \"{2}\" and by \"{1}\"",
                           joint.angles[i].key, SideName(side, joint), joint.plural);
      }
    }
  }
  return "";
}

void MentionedAngles::ApplyTo(AnatomicalPose& pose) const {
  const auto apply = [](const auto& mentioned, auto& angles) {
    for (std::size_t i = 0; i < angles.size(); ++i) {
      if (!std::isnan(mentioned[i])) angles[i] = mentioned[i];
    }
  };
  apply(midline_deg, pose.midline_deg);
  for (std::size_t side = 0; side < kSideCount; ++side) {
    apply(both_sides_deg, pose.sides_deg[side]);
    apply(sides_deg[side], pose.sides_deg[side]);
  }
}

}  // namespace vitruvia
