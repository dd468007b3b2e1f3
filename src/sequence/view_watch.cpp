#include "sequence/view_watch.h"

#include <algorithm>

#include <fmt/format.h>

namespace vitruvia {

void ViewWatch::Look(const std::vector<Vector3f>& vertices_in_camera, int frame) {
  const auto outside = std::count_if(vertices_in_camera.begin(), vertices_in_camera.end(),
                                     [this](const Vector3f& p) { return !camera_.InView(p); });
  if (outside == 0) return;
  if (frames_ == 0) first_ = frame;
  ++frames_;
  const double share =
      static_cast<double>(outside) / static_cast<double>(vertices_in_camera.size());
  if (share <= worst_share_) return;
  worst_share_ = share;
  worst_ = frame;
}

std::string ViewWatch::Warning(int frame_count) const {
  if (frames_ == 0) return "";
  return fmt::format(
      "the body leaves the image in {} of {} frames, first in frame {}; most of it in frame {}, "
      "where {:.3g} % of its vertices are outside",
      frames_, frame_count, first_, worst_, 100.0 * worst_share_);
}

}  // namespace vitruvia
