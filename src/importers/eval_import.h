// Recordings of the Stanford EVAL data set (importers/eval_file.h) made into sequences of ours:
// depth and true joints; there is no true surface.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "body/skeleton.h"
#include "config/settings.h"
#include "geometry/camera.h"

namespace vitruvia {

// What a joint's number means.
struct EvalJointName {
  int id = 0;
  std::string name;

  void Describe(Fields& fields);
  std::string Problem() const;
};

struct EvalImportSettings {
  std::vector<EvalJointName> joints;  // of all others the markers tell
  double marker_within_m = 0.1;
  std::filesystem::path subject;  // "": none
  double person_within_m = 0.0;
  double depth_unit_m = 0.001;
  double fps = 30.0;

  void Describe(Fields& fields);
  std::string Problem() const;
};

// What there was in the files.
struct EvalImport {
  PinholeCamera camera;
  double camera_residual_px = 0.0;  // root mean square, columns and rows together
  long points = 0;                  // that it was fitted to
  std::vector<std::string> joints;  // names in the order of ids
  UnmatchedJoints unmatched;
  int jumps = 0;  // frames whose number is not the one after their predecessor's
};

// Writes the sequence (sequence/sequence.h): the files are parts of one recording, in this order.
// The camera is fitted to the points. A joint is called what the settings say; else after the
// marker that lies nearest on average, if that is nearer than marker_within_m and to no other joint
// nearer still ("Left Elbow" is left_elbow); else joint_ID. DataError if the files are damaged or
// no pinhole camera sees what they hold.
EvalImport ImportEvalSequence(const std::vector<std::filesystem::path>& files,
                              const EvalImportSettings& settings,
                              const std::filesystem::path& folder);

}  // namespace vitruvia
