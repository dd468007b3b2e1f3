#include "scoring/own_surface_score.h"

#include "geometry/zbuffer.h"
#include "math/statistics.h"
#include "metrics/reconstruction_error.h"
#include "metrics/vertex_error.h"
#include "scoring/score.h"

namespace vitruvia {
namespace {

// Distances of one surface's vertices to the other surface.
struct OneWay {
  std::vector<double> all_m, visible_m;
};

OneWay DistancesOf(const TriangleMesh& from, const TriangleMesh& to, const PinholeCamera& camera,
                   ZBuffer& zbuffer) {
  OneWay distances;
  distances.all_m = DistancesToSurface(from.vertices, to);
  const DepthImage& rendered = zbuffer.Render(from.vertices, from.triangles);
  const std::vector<bool> visible =
      VisiblePoints(from.vertices, rendered, camera, kVisibleWithin_m);
  for (std::size_t i = 0; i < visible.size(); ++i) {
    if (visible[i]) distances.visible_m.push_back(distances.all_m[i]);
  }
  return distances;
}

void Append(const OneWay& of_frame, OneWay& all) {
  all.all_m.insert(all.all_m.end(), of_frame.all_m.begin(), of_frame.all_m.end());
  all.visible_m.insert(all.visible_m.end(), of_frame.visible_m.begin(), of_frame.visible_m.end());
}

void SummarizeSeries(const char* key, RunRecord& record) {
  const std::vector<double> values = PresentValues(record.frames.at(key));
  if (!values.empty()) record.summary[key] = Mean(values);
}

}  // namespace

void ScoreOwnSurfaces(const SequenceReader& sequence, const EstimateReader& estimate,
                      RunRecord& record) {
  if (!sequence.info().own_surfaces) return;
  const PinholeCamera& camera = sequence.info().camera;
  ZBuffer zbuffer(camera);
  TriangleMesh estimated = estimate.rest_mesh();
  OneWay both;  // of all frames and both directions
  for (int frame = 0; frame < sequence.info().frames; ++frame) {
    estimated.vertices = estimate.ReadVertices(frame);
    const TriangleMesh truth = sequence.ReadTrueSurface(frame);
    const OneWay to_truth = DistancesOf(estimated, truth, camera, zbuffer);
    const OneWay from_truth = DistancesOf(truth, estimated, camera, zbuffer);
    const double to = MeanOrAbsent(to_truth.all_m), from = MeanOrAbsent(from_truth.all_m);
    record.frames["to_truth_mean_m"].push_back(to);
    record.frames["from_truth_mean_m"].push_back(from);
    record.frames["two_way_mean_m"].push_back(0.5 * (to + from));
    record.frames["two_way_visible_mean_m"].push_back(
        0.5 * (MeanOrAbsent(to_truth.visible_m) + MeanOrAbsent(from_truth.visible_m)));
    Append(to_truth, both);
    Append(from_truth, both);
  }
  for (const char* key :
       {"to_truth_mean_m", "from_truth_mean_m", "two_way_mean_m", "two_way_visible_mean_m"})
    SummarizeSeries(key, record);
  if (!both.all_m.empty()) record.summary["two_way_p95_m"] = Quantile(both.all_m, 0.95);
  if (!both.visible_m.empty())
    record.summary["two_way_visible_p95_m"] = Quantile(both.visible_m, 0.95);
}

}  // namespace vitruvia
