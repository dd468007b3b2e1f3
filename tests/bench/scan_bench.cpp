// Scan fusion: time for each frame, and how near the surface comes to the truth.
#include "bench/bench.h"
#include "core/error.h"
#include "core/timer.h"
#include "geometry/surface_map.h"
#include "learning/scan/scan_fusion.h"
#include "math/rigid.h"
#include "synth/scan/scan_recorder.h"

namespace vitruvia::bench {
namespace {

constexpr int kScanFrames = 120;  // a third of a turn in 4 s

ScanSceneSettings Scene() {
  ScanSceneSettings scene;
  scene.truth.refinement.subdivisions = 3;
  scene.frames = kScanFrames;
  scene.path.turns = 0.3;
  scene.path.height_cycles = 0.5;
  return scene;
}

double MeanDistanceMm(const std::vector<Vector3f>& points, const TriangleMesh& surface) {
  const std::vector<SurfacePoint> nearest = ClosestSurfacePoints(points, surface);
  double sum_m = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum_m += (Evaluate(nearest[i], surface.vertices.data(), surface.triangles) - points[i]).norm();
  }
  return 1000.0 * sum_m / static_cast<double>(points.size());
}

}  // namespace

std::vector<Row> Scan() {
  ScanRecorder recorder(Scene());
  std::vector<ScanFrame> frames;
  for (int i = 0; i < kScanFrames; ++i) frames.push_back(recorder.Render(i));
  ScanFusion fusion(ScanFusionSettings{}, recorder.settings().camera,
                    Inverse(frames.front().camera_from_subject));
  std::vector<double> frame_ms;
  for (const ScanFrame& frame : frames) {
    const Stopwatch watch;
    const FusedFrame fused = fusion.FuseFrame(frame.depth);
    frame_ms.push_back(watch.ElapsedMs());
    if (fused.outcome != FrameOutcome::kFused) throw RunError("scan: " + fused.message);
  }
  const Stopwatch watch;
  const ScanSurface surface = fusion.Surface();
  return {Spread("scan_fuse_ms_per_frame", frame_ms, "ms"),
          {"scan_extract_ms", watch.ElapsedMs(), "ms"},
          {"scan_to_truth_mm", MeanDistanceMm(surface.mesh.vertices, recorder.surface()), "mm"}};
}

}  // namespace vitruvia::bench
