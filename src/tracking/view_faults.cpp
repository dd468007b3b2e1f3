#include "tracking/view_faults.h"

#include <algorithm>

namespace vitruvia {

bool ViewFaultSettings::AreNone() const {
  const ViewFaultSettings none;
  return order == none.order && mirrored == none.mirrored && only_px == none.only_px &&
         focal_factor == none.focal_factor;
}

int ViewFaultSettings::ShownFrame(int frame) const {
  const int since = frame - first_frame;
  if (since < 0 || since >= frames) return frame;
  switch (order) {
    case FrameOrder::kAsRecorded:
      break;
    case FrameOrder::kRepeated:
      return first_frame;
    case FrameOrder::kBackwards:
      return std::max(first_frame - since, 0);
  }
  return frame;
}

void ViewFaultSettings::DamageImage(DepthImage& depth) const {
  const auto [left, top, right, bottom] = only_px;
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      if (u < left || u > right || v < top || v > bottom) depth(u, v) = 0.0f;
    }
    if (!mirrored) continue;
    for (int u = 0; u < depth.width() / 2; ++u)
      std::swap(depth(u, v), depth(depth.width() - 1 - u, v));
  }
}

PinholeCamera ViewFaultSettings::ToldCamera(PinholeCamera camera) const {
  camera.fx *= focal_factor;
  camera.fy *= focal_factor;
  return camera;
}

void ViewFaultSettings::Describe(Fields& f) {
  f.Choice("order", order,
           {{"as_recorded", FrameOrder::kAsRecorded},
            {"repeated", FrameOrder::kRepeated},
            {"backwards", FrameOrder::kBackwards}},
           {.meaning = "images shown from first_frame on: the recorded ones, the image of "
                       "first_frame repeated, or the images before it in reverse order; the truth "
                       "remains that of the frame's number"});
  if (f.Applies(order != FrameOrder::kAsRecorded)) {
    f.Integer(
        "first_frame", first_frame,
        {.meaning = "first frame with a different image", .unit = "frames", .min = 0, .max = 1e6});
    f.Integer("frames", frames,
              {.meaning = "number of frames that show another image",
               .unit = "frames",
               .min = 1,
               .max = 1e6});
  }
  f.Flag("mirrored", mirrored, {.meaning = "left and right of all images are exchanged"});
  f.Numbers(
      "only_px", only_px,
      {.meaning =
           "left, top, right and bottom (inclusive) of the only part of all images that is shown",
       .unit = "px",
       .min = 0,
       .max = 1e6});
  f.Number("focal_factor", focal_factor,
           {.meaning = "factor on the focal lengths given to the tracker", .min = 0.1, .max = 10});
}

}  // namespace vitruvia
