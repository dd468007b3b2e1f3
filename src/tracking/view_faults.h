// Damage done to how a tracker sees a whole sequence: which image comes when, how it is turned, and
// what the tracker is told of its camera. The sequence and its truth stay whole.
#pragma once

#include <array>
#include <string>

#include "config/settings.h"
#include "geometry/camera.h"
#include "geometry/image.h"

namespace vitruvia {

// Which images are shown from some frame on.
enum class FrameOrder {
  kAsRecorded,
  kRepeated,   // that frame's image again and again
  kBackwards,  // the images before it, latest first
};

struct ViewFaultSettings {
  FrameOrder order = FrameOrder::kAsRecorded;
  int first_frame = 0;  // of another order
  int frames = 1;
  bool mirrored = false;                          // left and right of all images exchanged
  std::array<double, 4> only_px{0, 0, 1e6, 1e6};  // left, top, right, bottom: nothing else is shown
  double focal_factor = 1.0;                      // on the focal lengths that the tracker is told

  bool AreNone() const;
  int ShownFrame(int frame) const;  // the frame whose image is shown as this one
  void DamageImage(DepthImage& depth) const;
  PinholeCamera ToldCamera(PinholeCamera camera) const;
  void Describe(Fields& fields);
};

}  // namespace vitruvia
