#include "tracking/astray.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

namespace vitruvia {
namespace {

constexpr int kEvery = 4;  // pixels along both axes: the middle needs no more

// Does not copy the points, because a copy would count as the tracker's memory.
std::optional<Vector3d> MiddleOf(const DepthImage& depth, const PinholeCamera& camera) {
  Vector3d sum = Vector3d::Zero();
  long count = 0;
  for (int v = 0; v < depth.height(); v += kEvery) {
    for (int u = 0; u < depth.width(); u += kEvery) {
      const double z = depth(u, v);
      if (!(z > 0.0)) continue;
      sum += camera.Unproject<double>(u, v, z);
      ++count;
    }
  }
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

}  // namespace

void MarkAstray(const DepthFrame& frame, const PinholeCamera& camera, double diagonal_m,
                TrackResult& result) {
  if (IsFailure(result.outcome)) return;
  const std::optional<Vector3d> middle = MiddleOf(frame.depth, camera);
  if (!middle) return;
  double farthest_m = 0.0;
  for (const Vector3f& vertex : result.vertices)
    farthest_m = std::max(farthest_m, (vertex.cast<double>() - *middle).norm());
  if (farthest_m <= kAstrayBeyond_diagonals * diagonal_m) return;
  result.outcome = Outcome::kLost;
  result.message = fmt::format(
      "astray: a vertex is {:.3g} m from the middle of the measured points, {:.3g} times the "
      "subject's diagonal{}{}",
      farthest_m, farthest_m / diagonal_m, result.message.empty() ? "" : "; ", result.message);
}

}  // namespace vitruvia
