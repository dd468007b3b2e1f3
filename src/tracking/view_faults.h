// Faults in a tracker's view of a whole sequence: the order of images, their orientation, and the
// intrinsics given to the tracker. The sequence and its truth stay intact.
#pragma once

#include <array>
#include <string>

#include "config/settings.h"
#include "geometry/camera.h"
#include "geometry/image.h"

namespace vitruvia {

// Order of the images from a given frame on.
enum class FrameOrder {
  kAsRecorded,
  kRepeated,   // that frame's image is repeated
  kBackwards,  // the images before it, latest first
};

struct ViewFaultSettings {
  FrameOrder order = FrameOrder::kAsRecorded;
  int first_frame = 0;  // the first frame with a different order
  int frames = 1;
  bool mirrored = false;                          // left and right of all images exchanged
  std::array<double, 4> only_px{0, 0, 1e6, 1e6};  // left, top, right, bottom: pixels outside are
                                                  // removed
  double focal_factor = 1.0;                      // factor on the focal lengths given to the
                                                  // tracker

  bool AreNone() const;
  int ShownFrame(int frame) const;  // the frame whose image is shown as this one
  void DamageImage(DepthImage& depth) const;
  PinholeCamera ToldCamera(PinholeCamera camera) const;
  void Describe(Fields& fields);
};

}  // namespace vitruvia
