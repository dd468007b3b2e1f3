#include "subjects/scan.h"

#include <algorithm>

#include "core/build_info.h"
#include "core/error.h"
#include "core/one_ahead.h"
#include "core/progress.h"
#include "core/timer.h"
#include "geometry/surface_map.h"
#include "math/angles.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "math/statistics.h"
#include "sequence/sequence.h"
#include "synth/scan/scan_recorder.h"

namespace vitruvia {
namespace {

void RequireFused(const FusedFrame& fused, int frame) {
  if (fused.outcome == FrameOutcome::kEmpty && frame == 0) {
    throw DataError(fmt::format("scan: no body: frame {}: {}", frame, fused.message));
  }
  if (fused.outcome != FrameOutcome::kFused) {
    throw RunError(fmt::format("scan: the camera is lost in frame {}: {}", frame, fused.message));
  }
}

// Fuses every stride-th of `count` frames that `depth_of` gives.
ScanSurface Fuse(const ScanSettings& settings, ScanFusion& fusion, int count,
                 const std::function<DepthImage(int)>& depth_of, ScanResult& result) {
  {
    const int stride = settings.fusion.stride, steps = (count + stride - 1) / stride;
    Progress progress("scan", steps);
    const auto depth_of_step = [&](int step) {
      const Stopwatch watch;
      DepthImage depth = depth_of(step * stride);
      result.render_ms += watch.ElapsedMs();
      return depth;
    };
    MakeOneAhead(steps, depth_of_step, [&](int step, const DepthImage& depth) {
      const Stopwatch watch;
      const FusedFrame fused = fusion.FuseFrame(depth);
      result.fuse_ms += watch.ElapsedMs();
      RequireFused(fused, step * stride);
      result.frames.push_back(fused);
      progress.Advance();
    });
  }
  Stopwatch watch;
  ScanSurface surface = fusion.Surface();
  result.extract_ms = watch.LapMs();
  return surface;
}

CameraPathError PathError(const std::vector<FusedFrame>& frames,
                          const std::vector<Rigidd>& true_subject_from_camera) {
  std::vector<double> turned_deg, moved_m;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Rigidd& estimate = frames[i].subject_from_camera;
    const Rigidd& truth = true_subject_from_camera[i];
    turned_deg.push_back(LogSo3<double>(truth.rotation.transpose() * estimate.rotation).norm() /
                         kRadiansPerDegree);
    moved_m.push_back((estimate.translation - truth.translation).norm());
  }
  return {Mean(turned_deg), Maximum(turned_deg), Mean(moved_m), Maximum(moved_m)};
}

ScanResult ScanScene(const ScanSettings& settings, ScanRecorder recorder) {
  ScanFrame first = recorder.Render(0);
  ScanFusion fusion(settings.fusion, settings.scene.camera, Inverse(first.camera_from_subject));
  ScanResult result;
  std::vector<Rigidd> true_path;
  result.surface = Fuse(
      settings, fusion, settings.scene.frames,
      [&](int frame) {
        ScanFrame rendered = recorder.Render(frame);
        true_path.push_back(Inverse(rendered.camera_from_subject));
        return std::move(rendered.depth);
      },
      result);
  RequireOneWholeBody(result.surface, settings.check);
  result.truth = {recorder.body(), recorder.surface(), PathError(result.frames, true_path), {}, {}};
  return result;
}

ScanResult WithDistances(ScanResult result) {
  if (!result.truth) return result;
  result.truth->scan_to_truth = SurfaceDistance(result.surface.mesh, result.truth->surface);
  result.truth->truth_to_scan = SurfaceDistance(result.truth->surface, result.surface.mesh);
  return result;
}

ScanResult ScanSequence(const ScanSettings& settings) {
  const SequenceReader sequence(settings.sequence);
  ScanFusion fusion(settings.fusion, sequence.info().camera,
                    Inverse(CameraFromSubject(settings.first_view)));
  ScanResult result;
  result.surface = Fuse(
      settings, fusion, sequence.info().frames,
      [&](int frame) { return sequence.ReadDepth(frame); }, result);
  RequireOneWholeBody(result.surface, settings.check);
  return result;
}

Json ToJson(const DistanceSummary& d) {
  return {{"mean_m", d.mean_m}, {"p95_m", d.p95_m}, {"max_m", d.max_m}};
}

Json ToJson(const Vector3f& p) { return {p.x(), p.y(), p.z()}; }

Json TruthJson(const ScanTruth& truth) {
  return {{"scan_to_truth", ToJson(truth.scan_to_truth)},
          {"truth_to_scan", ToJson(truth.truth_to_scan)},
          {"camera_path",
           {{"rotation_mean_deg", truth.path.rotation_mean_deg},
            {"rotation_max_deg", truth.path.rotation_max_deg},
            {"translation_mean_m", truth.path.translation_mean_m},
            {"translation_max_m", truth.path.translation_max_m}}},
          {"attributes",
           {{"height_m", truth.body.attributes.height_m},
            {"weight_kg", truth.body.attributes.weight_kg}}}};
}

Json SurfaceJson(const ScanSurface& surface) {
  Json components = Json::array(), holes = Json::array();
  for (const SurfaceComponent& c : surface.components) {
    components.push_back({{"area_m2", c.area_m2},
                          {"triangles", c.triangles},
                          {"low_m", ToJson(c.box.min())},
                          {"high_m", ToJson(c.box.max())},
                          {"kept", c.kept}});
  }
  for (const BoundaryLoop& hole : surface.holes) {
    holes.push_back({{"perimeter_m", hole.perimeter_m},
                     {"area_m2", hole.area_m2},
                     {"center_m", ToJson(hole.center)},
                     {"edges", hole.edges}});
  }
  return {{"vertices", surface.mesh.vertices.size()},
          {"triangles", surface.mesh.triangles.size()},
          {"area_m2", SurfaceArea(surface.mesh)},
          {"components", components},
          {"holes", holes}};
}

Json TimesJson(const ScanResult& result) {
  Json steps = Json::object();
  std::vector<double> all;
  for (const FusedFrame& frame : result.frames) {
    double sum = 0.0;
    for (const double ms : frame.step_ms) sum += ms;
    all.push_back(sum);
  }
  for (std::size_t step = 0; step < kScanStepCount; ++step) {
    std::vector<double> ms;
    for (const FusedFrame& frame : result.frames) ms.push_back(frame.step_ms[step]);
    steps[kScanStepNames[step]] = {{"median_ms", Quantile(ms, 0.5)}, {"max_ms", Maximum(ms)}};
  }
  return {{"frame_ms_median", Quantile(all, 0.5)}, {"frame_ms_p95", Quantile(all, 0.95)},
          {"frame_ms_max", Maximum(all)},          {"steps", steps},
          {"obtain_frames_ms", result.render_ms},  {"fuse_ms", result.fuse_ms},
          {"extract_ms", result.extract_ms}};
}

Json FramesJson(const std::vector<FusedFrame>& frames) {
  std::vector<double> shares, rms, conditions;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    shares.push_back(frames[i].matched_share);
    rms.push_back(frames[i].rms_m);
    conditions.push_back(frames[i].condition);
  }
  Json json = {{"fused", frames.size()}};
  if (shares.empty()) return json;
  json["matched_share_min"] = *std::min_element(shares.begin(), shares.end());
  json["matched_share_mean"] = Mean(shares);
  json["rms_mean_m"] = Mean(rms);
  json["rms_max_m"] = Maximum(rms);
  json["condition_median"] = Quantile(conditions, 0.5);
  json["condition_max"] = Maximum(conditions);
  return json;
}

}  // namespace

void ScanSettings::Describe(Fields& f) {
  f.Text("title", title, {.meaning = "what is scanned, for people"});
  f.Choice("source", source, {{"scene", ScanSource::kScene}, {"sequence", ScanSource::kSequence}},
           {.meaning = "scene: frames are rendered one by one; sequence: they are read from a "
                       "folder"});
  if (f.Applies(source == ScanSource::kScene)) {
    f.Section("scene", scene, {.meaning = "who is scanned and how the camera moves"});
  }
  if (f.Applies(source == ScanSource::kSequence)) {
    f.File("sequence", sequence, {.meaning = "folder of the sequence", .required = true});
    f.Section("first_view", first_view,
              {.meaning = "camera pose of the first frame, from which the scan's floor and front "
                          "follow; its intrinsics are not used, because the sequence has them"});
  }
  f.Section("fusion", fusion, {.meaning = "how frames become a surface"});
  f.Section("check", check, {.meaning = "requirements of the surface"});
}

ScanSettings ReadScanSettings(const std::filesystem::path& file, const Json& overrides) {
  return ReadSettings<ScanSettings>(Merged(ReadJsonFile(file), overrides), {file, ""});
}

DistanceSummary SurfaceDistance(const TriangleMesh& from, const TriangleMesh& to) {
  const std::vector<SurfacePoint> nearest = ClosestSurfacePoints(from.vertices, to);
  std::vector<double> distances_m;
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    distances_m.push_back(
        (Evaluate(nearest[i], to.vertices.data(), to.triangles) - from.vertices[i]).norm());
  }
  return {Mean(distances_m), Quantile(distances_m, 0.95), Maximum(distances_m)};
}

ScanResult ScanWithoutDistances(const ScanSettings& settings) {
  return settings.source == ScanSource::kScene ? ScanScene(settings, ScanRecorder(settings.scene))
                                               : ScanSequence(settings);
}

ScanResult Scan(const ScanSettings& settings) {
  return WithDistances(ScanWithoutDistances(settings));
}

ScanResult ScanPerson(const ScanSettings& settings, const BodyModel& person) {
  return WithDistances(ScanScene(settings, ScanRecorder(settings.scene, person)));
}

Json ScanRecord(const ScanSettings& settings, const ScanResult& result) {
  Json record = {{"made_by", "vitruvia scan"},
                 {"settings", WriteSettings(settings)},
                 {"frame",
                  "subject frame: y up, z to the front, floor at y = 0, as far as the first "
                  "camera's place over the floor is known"},
                 {"frames", FramesJson(result.frames)},
                 {"surface", SurfaceJson(result.surface)},
                 {"times", TimesJson(result)},
                 {"build", Provenance()}};
  if (result.truth) record["truth"] = TruthJson(*result.truth);
  return record;
}

}  // namespace vitruvia
