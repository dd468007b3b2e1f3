// An interpreted motion capture clip: with mapped joints, in the subject's axes, scaled to a body,
// and checked.
#pragma once

#include "synth/motions/mocap_axes.h"
#include "synth/motions/mocap_check.h"

namespace vitruvia {

// User settings that override a motion capture file.
struct MocapSettings {
  UpAxis up_axis = UpAxis::kFromFile;
  std::vector<MocapJointName> joints;

  void Describe(Fields& fields);
  std::string Problem() const;
};

struct MocapPerformer {
  MocapClip clip;  // x left, y up, z front in the first frame, which is at the origin; metres
  MocapJoints joints;
  MocapAxes axes;  // of the file
  // Horizontal front direction of the first frame, in the file's axes.
  Vector3<double> facing = Vector3<double>::Zero();
  double metres_per_unit = 0.0;  // of the file, so that the legs are as long as the body's
  MocapCheck check;

  // Of reading, axes and check.
  std::vector<std::string> Warnings() const;
};

// DataError naming the file if its joints are not those of a person, or if its up direction cannot
// be determined.
MocapPerformer Understand(MocapClip clip, const MocapSettings& settings, const Skeleton& skeleton);

// Mean length of a body's legs.
double LegLength(const Skeleton& skeleton);

}  // namespace vitruvia
