// Damage done to what a tracker is handed. The sequence and its truth stay whole, so the scores say
// what the damage cost. For what no image file can hold (numbers that are none) and no generator
// makes (a template with broken triangles).
#pragma once

#include <string>

#include "body/body_model.h"
#include "config/settings.h"
#include "tracking/tracker.h"
#include "tracking/view_faults.h"

namespace vitruvia {

// What a damaged pixel holds.
enum class DepthFault {
  kNone,
  kZero,     // no measurement
  kMaximum,  // the largest number of a 16-bit image
  kNotANumber,
  kInfinite,
  kNegative,  // the depth behind the camera
};

struct DepthFaultSettings {
  DepthFault kind = DepthFault::kNone;
  int first_frame = 0;
  int frames = 1;
  double share = 1.0;     // of a damaged frame's pixels
  int pixels_spared = 0;  // measured ones, nearest to the image's middle

  void Describe(Fields& fields);
};

struct SubjectFaultSettings {
  std::string bone_without_vertices;  // its weights go to its parent
  int duplicate_triangles = 0;        // that stand twice
  int degenerate_triangles = 0;       // that have two corners in one vertex
  double size_factor = 1.0;           // on all lengths of the template and its skeleton

  void Describe(Fields& fields);
  std::string Problem() const;
};

struct InputFaultSettings {
  DepthFaultSettings depth;
  SubjectFaultSettings subject;
  ViewFaultSettings view;

  bool AreNone() const;
  void Describe(Fields& fields);
};

// The frame as the tracker gets it. The same seed damages the same pixels.
void DamageFrame(const DepthFaultSettings& settings, double depth_unit_m, int seed,
                 DepthFrame& frame);

// The subject as the tracker gets it.
void DamageSubject(const SubjectFaultSettings& settings, Subject& subject);

}  // namespace vitruvia
