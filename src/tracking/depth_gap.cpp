#include "tracking/depth_gap.h"

#include <algorithm>

#include "geometry/depth_stretches.h"

namespace vitruvia {

double SquaredDepthGap_m2(const DepthImage& rendered, const DepthImage& measured, int stride,
                          double max_depth_m) {
  constexpr double kMost_m2 = 0.05 * 0.05;
  double sum_m2 = 0.0;
  long pixels = 0;
  for (int v = 0; v < rendered.height(); v += stride) {
    ForEachStretchWithDepth(
        rendered.width(), stride, {&rendered(0, v), &measured(0, v)}, [&](int begin, int end) {
          for (int u = begin; u < end; u += stride) {
            const double model_m = rendered(u, v), frame_m = measured(u, v);
            const bool is_model = model_m > 0.0, is_frame = frame_m > 0.0 && frame_m <= max_depth_m;
            if (!is_model && !is_frame) continue;
            pixels += is_model ? 1 : 0;
            const double gap_m = model_m - frame_m;
            sum_m2 += is_model && is_frame ? std::min(gap_m * gap_m, kMost_m2) : kMost_m2;
          }
        });
  }
  return pixels > 0 ? sum_m2 / static_cast<double>(pixels) : 0.0;
}

}  // namespace vitruvia
