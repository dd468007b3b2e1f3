// The kinematic skeleton as a hand-written JSON file of hinges and prismatic joints.
//
// Names follow URDF where it defines them. Each joint carries one link, which has the joint's name.
// In the bind pose every joint value is 0, every link's axes are those of the subject frame, and
// each joint sits where the subject's own 17-bone skeleton says (`at`), so one file serves bodies
// of all proportions. A ball joint is three hinges in a row (paper B, sec. 3.1).
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "config/settings.h"

namespace vitruvia::dynamic {

enum class JointType { kHinge, kPrismatic };

struct LimitSettings {
  double lower = 0.0, upper = 0.0;
  void Describe(Fields& fields);
};

struct JointSettings {
  std::string name;
  JointType type = JointType::kHinge;
  std::string parent;  // name of the joint whose link carries this one, or kWorld
  std::string at;      // joint of the subject's skeleton: "left_elbow"
  std::array<double, 3> axis{0.0, 0.0, 0.0};
  std::string towards;  // joint or bone whose place the axis points at, instead of `axis`
  LimitSettings limit_deg, limit_m;
  double prior = 1.0;
  std::string bone;  // the subject's bone that moves with this joint's link, "" for none

  void Describe(Fields& fields);
};

inline constexpr const char* kWorld = "world";

struct SkeletonFile {
  std::string name, description;
  std::vector<JointSettings> joints;  // in any order

  void Describe(Fields& fields);
  // Cycles, unknown parents, axes without length, reversed limits, names and bones used twice: a
  // message that names the joint and the problem, or "".
  std::string Problem() const;
};

// ConfigError naming the file, the joint and what is wrong with it.
SkeletonFile ReadSkeletonFile(const std::filesystem::path& file);

}  // namespace vitruvia::dynamic
