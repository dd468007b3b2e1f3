// Acclaim skeletons (.asf).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "math/angles.h"
#include "math/vector.h"
#include "synth/motions/mocap_words.h"

namespace vitruvia {

// One number of a bone's line in a motion file.
struct AsfChannel {
  int axis = 0;  // 0 … 2: x, y, z
  bool is_rotation = true;
};

struct AsfBone {
  std::string name;
  int line = 0;
  int parent = -1;
  Vector3<double> direction = Vector3<double>::Zero();  // of the bone at rest, unit length
  double length = 0.0;
  Eigen::Quaterniond axes =
      Eigen::Quaterniond::Identity();  // rest_from_local: what the channels turn about
  std::vector<AsfChannel> channels;
};

struct AsfSkeleton {
  std::vector<AsfBone> bones;  // the root first, parents before children
  double radians_per_unit = kRadiansPerDegree;
  std::vector<std::string> warnings;  // assumptions about what the file does not state

  std::optional<int> Find(std::string_view name) const;
};

// The turn about a coordinate axis (0 … 2) by an angle in radians.
Eigen::Quaterniond TurnAbout(int axis, double angle);

// Section names and keys may be in any case. DataError naming file and line if the file is missing,
// damaged or cut short, or holds a section or a key that the format does not have.
AsfSkeleton ReadAsf(const std::filesystem::path& file);

// DataError at the word's line: `word` is none of `known`; names the nearest of them.
[[noreturn]] void FailUnknown(const MocapWords& words, const MocapWords::Word& word,
                              std::string_view what, const std::vector<std::string>& known);

}  // namespace vitruvia
