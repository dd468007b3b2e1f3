// Faults injected into a tracker's input. The sequence and its truth stay intact, so the scores
// measure the effect of the fault. For faults that an image file cannot store (NaN) or that no
// generator produces (a template with invalid triangles).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "body/body_model.h"
#include "config/settings.h"
#include "tracking/tracker.h"
#include "tracking/view_faults.h"

namespace vitruvia {

// The value of a damaged pixel.
enum class DepthFault {
  kNone,
  kZero,     // no measurement
  kMaximum,  // the largest number of a 16-bit image
  kNotANumber,
  kInfinite,
  kNegative,  // the depth behind the camera
};

// The part of an image that is damaged.
enum class FaultPlace { kImage, kRegion, kBone };

struct DepthFaultSettings {
  DepthFault kind = DepthFault::kNone;
  int first_frame = 0;
  int frames = 1;
  FaultPlace place = FaultPlace::kImage;
  std::array<double, 4> region_px{0.0, 0.0, 0.0, 0.0};  // left, top, right, bottom; inclusive
  std::string bone;
  double bone_radius_m = 0.15;  // about the bone
  double share = 1.0;           // share of the damaged part's pixels
  int pixels_spared = 0;        // number of measured pixels, nearest to the centre of the image,
                                // that are not damaged

  bool Damages(int frame) const {
    return kind != DepthFault::kNone && frame >= first_frame && frame < first_frame + frames;
  }
  void Describe(Fields& fields);
  std::string Problem() const;
};

struct SubjectFaultSettings {
  std::string bone_without_vertices;  // its weights go to its parent
  int duplicate_triangles = 0;        // number of triangles that are duplicated
  int degenerate_triangles = 0;       // number of triangles of which two corners become the same
                                      // vertex
  double size_factor = 1.0;           // factor on all lengths of the template and its skeleton

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

// From the true joint of a bone to that of one of its children, camera frame, metres.
using BoneSegment = std::array<Vector3d, 2>;

// The inputs of a fault other than its settings.
struct FaultContext {
  double depth_unit_m = 0.001;
  int seed = 1;
  PinholeCamera camera;
  std::vector<BoneSegment> bone{};  // for a fault at a bone: its segments in this frame
};

// Segments of the named bone, given the true joints in the order of Bones(). A bone without
// children has one segment of zero length.
std::vector<BoneSegment> BoneSegments(const std::string& bone, const std::vector<Vector3d>& joints);

// Damages the frame before the tracker gets it. The same seed damages the same pixels.
void DamageFrame(const DepthFaultSettings& settings, const FaultContext& context,
                 DepthFrame& frame);

// Damages the subject before the tracker gets it.
void DamageSubject(const SubjectFaultSettings& settings, Subject& subject);

}  // namespace vitruvia
