// The baselines' milliseconds per 320×240 frame on one thread, and how near they stay.
#include "bench/bench.h"
#include "core/timer.h"
#include "math/rigid.h"
#include "methods/registry.h"
#include "support/arm_stage.h"

namespace vitruvia::bench {

std::vector<Row> Baselines() {
  constexpr int kFrames = 40;
  ArmStage stage(1, SkinLinear, {Vector3d(1, -1, -1).asDiagonal(), {0.05, 0.9, 2.8}});
  std::vector<Row> rows;
  for (const char* method : {"capsule_icp", "sdf_parts", "gmm_articulated"}) {
    const std::unique_ptr<Tracker> tracker =
        MakeTracker(ReadMethodConfig({{"method", method}}, {"baselines_bench", ""}));
    tracker->Start(stage.body, stage.camera);
    std::vector<double> ms, error_mm;
    for (int i = 0; i < kFrames; ++i) {
      const double angle = 0.03 * i;
      const DepthFrame frame = stage.Frame(i, angle);
      const Stopwatch watch;
      const TrackResult result = tracker->TrackFrame(frame);
      if (i > 0) ms.push_back(watch.ElapsedMs());
      error_mm.push_back(1e3 * stage.MeanError(result, angle));
    }
    rows.push_back({std::string(method) + "_frame_median", Median(ms), "ms"});
    rows.push_back({std::string(method) + "_error_median", Median(error_mm), "mm"});
  }
  return rows;
}

}  // namespace vitruvia::bench
