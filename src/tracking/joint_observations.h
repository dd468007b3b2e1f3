// Joint positions from an external detector for each frame, as a file (format
// "vitruvia-joint-observations"), for trackers that use such joints as input.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "body/body_points.h"
#include "config/stored_data.h"

namespace vitruvia {

struct ObservedJoints {
  std::vector<Vector3<double>> positions;  // camera frame, metres; NaN where not observed

  void Describe(Fields& fields);
};

struct JointObservations {
  static constexpr StoredFormat kFormat{"vitruvia-joint-observations", 1, 1,
                                        "make the observations again"};

  std::string source;               // the detector that made the observations, as text
  std::vector<std::string> joints;  // names (body/body_points.h), in the order of positions
  std::vector<ObservedJoints> frames;

  void Describe(Fields& fields);
  std::string Problem() const;  // a frame with more or fewer positions than names
};

// The observed positions of the body's points in a frame; joints of other names are ignored.
// DataError if the file does not have the frame.
std::array<std::optional<Vector3<double>>, kBodyPointCount> ObservedPoints(
    const JointObservations& observations, int frame);

}  // namespace vitruvia
