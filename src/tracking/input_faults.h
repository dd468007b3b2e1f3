// Damage done to what a tracker is handed. The sequence and its truth stay whole, so the scores say
// what the damage cost. For what no image file can hold (numbers that are none) and no generator
// makes (a template with broken triangles).
#pragma once

#include <array>
#include <string>
#include <vector>

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

// Which part of an image is damaged.
enum class FaultPlace { kImage, kRegion, kBone };

struct DepthFaultSettings {
  DepthFault kind = DepthFault::kNone;
  int first_frame = 0;
  int frames = 1;
  FaultPlace place = FaultPlace::kImage;
  std::array<double, 4> region_px{0.0, 0.0, 0.0, 0.0};  // left, top, right, bottom; both ends in it
  std::string bone;
  double bone_radius_m = 0.15;  // round the bone
  double share = 1.0;           // of the damaged part's pixels
  int pixels_spared = 0;        // measured ones, nearest to the image's middle

  bool Damages(int frame) const {
    return kind != DepthFault::kNone && frame >= first_frame && frame < first_frame + frames;
  }
  void Describe(Fields& fields);
  std::string Problem() const;
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

// From the true joint of a bone to that of a bone that hangs on it, camera frame, metres.
using BoneSegment = std::array<Vector3d, 2>;

// What a fault depends on beside its settings.
struct FaultContext {
  double depth_unit_m = 0.001;
  int seed = 1;
  PinholeCamera camera;
  std::vector<BoneSegment> bone{};  // of a fault at a bone, in this frame
};

// Of the named bone, given the true joints in the order of Bones(). A bone that carries no other
// has one segment, of no length.
std::vector<BoneSegment> BoneSegments(const std::string& bone, const std::vector<Vector3d>& joints);

// The frame as the tracker gets it. The same seed damages the same pixels.
void DamageFrame(const DepthFaultSettings& settings, const FaultContext& context,
                 DepthFrame& frame);

// The subject as the tracker gets it.
void DamageSubject(const SubjectFaultSettings& settings, Subject& subject);

}  // namespace vitruvia
