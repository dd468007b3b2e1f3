#include "tracking/joint_observations.h"

#include "core/error.h"

namespace vitruvia {

void ObservedJoints::Describe(Fields& f) {
  f.Points(
      "positions", positions,
      {.meaning = "positions of the joints in the camera frame", .unit = "m", .null_items = true});
}

void JointObservations::Describe(Fields& f) {
  f.Text("source", source, {.meaning = "detector that observed the joints, as text"});
  f.Texts("joints", joints, {.meaning = "names of the joints"});
  f.List("frames", frames, {.meaning = "the joints of each frame of a sequence"});
}

std::string JointObservations::Problem() const {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].positions.size() != joints.size()) {
      return fmt::format("frames[{}]: {} positions, expected one for each of the {} joints", i,
                         frames[i].positions.size(), joints.size());
    }
  }
  return "";
}

std::array<std::optional<Vector3<double>>, kBodyPointCount> ObservedPoints(
    const JointObservations& observations, int frame) {
  if (frame < 0 || frame >= static_cast<int>(observations.frames.size())) {
    throw DataError(fmt::format(
        "joint observations: no frame {}, the file has {}; expected one for each frame of the "
        "sequence that is tracked",
        frame, observations.frames.size()));
  }
  std::array<std::optional<Vector3<double>>, kBodyPointCount> points;
  const std::vector<Vector3<double>>& positions =
      observations.frames[static_cast<std::size_t>(frame)].positions;
  for (std::size_t j = 0; j < observations.joints.size(); ++j) {
    const int point = FindBodyPoint(observations.joints[j]);
    if (point >= 0 && positions[j].allFinite()) points[point] = positions[j];
  }
  return points;
}

}  // namespace vitruvia
