// Converts recordings of the Stanford EVAL data set (importers/eval_file.h) to sequences with depth
// and true joints, without a true surface.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "body/skeleton.h"
#include "config/settings.h"
#include "geometry/camera.h"

namespace vitruvia {

// The joint that an id stands for.
struct EvalJointName {
  int id = 0;
  std::string name;

  void Describe(Fields& fields);
  std::string Problem() const;
};

struct EvalImportSettings {
  std::vector<EvalJointName> joints;  // the others are named after markers
  double marker_within_m = 0.1;
  std::filesystem::path subject;  // "": none
  double person_within_m = 0.0;
  double depth_unit_m = 0.001;
  double fps = 30.0;

  void Describe(Fields& fields);
  std::string Problem() const;
};

// What was found in the files.
struct EvalImport {
  PinholeCamera camera;
  double camera_residual_px = 0.0;  // root mean square, columns and rows together
  long points = 0;                  // number of points that the camera was fitted to
  std::vector<std::string> joints;  // names in the order of ids
  UnmatchedJoints unmatched;
  int jumps = 0;  // frames whose number does not follow their predecessor's
};

// Writes the sequence (sequence/sequence.h): the files are parts of one recording, in this order.
// The camera is fitted to the points. A joint has its name from the settings; otherwise that of the
// marker nearest to it on average, if that marker is nearer than marker_within_m and not nearer to
// another joint ("Left Elbow" becomes left_elbow); otherwise joint_ID. DataError if the files are
// damaged or no pinhole camera fits the points.
EvalImport ImportEvalSequence(const std::vector<std::filesystem::path>& files,
                              const EvalImportSettings& settings,
                              const std::filesystem::path& folder);

}  // namespace vitruvia
