#include "reports/viewer/viewed_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "core/error.h"
#include "core/progress.h"
#include "geometry/zbuffer.h"
#include "metrics/catalogue.h"
#include "metrics/vertex_error.h"
#include "reports/drawing/color_maps.h"
#include "scoring/bone_placement.h"
#include "scoring/score.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

constexpr double kSmallestErrorScale_m = 0.01;
constexpr int kMostDepthPixels = 20'000;  // of a frame
constexpr double kDepthStep_m = 0.001;
constexpr int kPointsOfOwnSurface = 6000;  // of a true surface whose triangles change

template <class Value>
void Append(const std::vector<Value>& more, std::vector<Value>& all) {
  all.insert(all.end(), more.begin(), more.end());
}

// The frames of the page that the run has.
std::vector<int> FramesOf(const OpenedRun& run, const PageFrame& page) {
  std::vector<int> frames;
  for (const int frame : page.stored_frames) {
    if (frame < run.frame_count()) frames.push_back(frame);
  }
  return frames;
}

Json CameraContent(const PinholeCamera& camera) {
  return {{"width", camera.width}, {"height", camera.height}, {"fx", camera.fx},
          {"fy", camera.fy},       {"cx", camera.cx},         {"cy", camera.cy}};
}

// Every so many pixels in either direction, in millimetres.
Json DepthContent(const OpenedRun& run, const std::vector<int>& frames, PackedArrays& arrays) {
  const PinholeCamera& camera = run.sequence->info().camera;
  int every = 1;
  while (camera.width / every * (camera.height / every) > kMostDepthPixels) ++every;
  const int columns = (camera.width + every - 1) / every;
  const int rows = (camera.height + every - 1) / every;
  std::vector<std::uint16_t> depths;
  std::uint16_t nearest = std::numeric_limits<std::uint16_t>::max(), farthest = 0;
  for (const int frame : frames) {
    const DepthImage depth = run.sequence->ReadDepth(frame);
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const double units = depth(column * every, row * every) / kDepthStep_m;
        depths.push_back(static_cast<std::uint16_t>(std::clamp(std::round(units), 0.0, 65535.0)));
        if (depths.back() == 0) continue;
        nearest = std::min(nearest, depths.back());
        farthest = std::max(farthest, depths.back());
      }
    }
  }
  return {{"every", every},
          {"columns", columns},
          {"rows", rows},
          {"step_m", kDepthStep_m},
          {"nearest", nearest},
          {"farthest", farthest},
          {"values", arrays.Words(depths, static_cast<int>(frames.size()))}};
}

// Three coordinates of each joint of each frame, NaN where it is not known.
std::vector<float> TrueJoints(const SequenceReader& sequence) {
  std::vector<float> values;
  for (int frame = 0; frame < sequence.info().frames; ++frame) {
    const JointTruth& truth = sequence.true_joints(frame);
    for (std::size_t j = 0; j < truth.positions.size(); ++j) {
      for (int axis = 0; axis < 3; ++axis)
        values.push_back(truth.Knows(j) ? static_cast<float>(truth.positions[j][axis]) : NAN);
    }
  }
  return values;
}

Json TrueSurface(const OpenedRun& run, const std::vector<int>& frames, const PageFrame& page,
                 PackedArrays& arrays) {
  const ThinnedMesh mesh = Thinned(run.sequence->true_rest_mesh(), page.most_vertices);
  std::vector<std::uint16_t> positions;
  for (const int frame : frames)
    Append(page.grid.Quantised(mesh.Of(run.sequence->ReadTrueVertices(frame))), positions);
  const PackedSurface surface = arrays.Surface(mesh.triangles, mesh.kept.size());
  return {{"vertices", run.sequence->true_rest_mesh().vertices.size()},
          {"shown", mesh.kept.size()},
          {"triangles", surface.triangles},
          {"positions", arrays.On(surface, positions, static_cast<int>(frames.size()))}};
}

// Of a surface with its own triangles in each frame: so many of its vertices, as points.
Json OwnTrueSurface(const OpenedRun& run, const std::vector<int>& frames, const PageFrame& page,
                    PackedArrays& arrays) {
  std::vector<std::uint16_t> positions;
  for (const int frame : frames) {
    const std::vector<Vector3f> all = run.sequence->ReadTrueSurface(frame).vertices;
    std::vector<Vector3f> some;
    for (std::size_t i = 0; i < kPointsOfOwnSurface && !all.empty(); ++i)
      some.push_back(all[i * all.size() / kPointsOfOwnSurface]);
    some.resize(kPointsOfOwnSurface, page.grid.origin);
    Append(page.grid.Quantised(some), positions);
  }
  return {{"shown", kPointsOfOwnSurface},
          {"positions", arrays.Words(positions, static_cast<int>(frames.size()))}};
}

// The square root of the length as a share of the largest one: fine where lengths are small.
std::vector<std::uint8_t> LengthBytes(const std::vector<float>& lengths_m, float most_m) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(lengths_m.size());
  for (const float length_m : lengths_m) {
    const float told_m = std::round(length_m / kFinestStep_m) * kFinestStep_m;
    const float share = most_m > 0.0f ? std::clamp(told_m / most_m, 0.0f, 1.0f) : 0.0f;
    bytes.push_back(static_cast<std::uint8_t>(std::lround(255.0f * std::sqrt(share))));
  }
  return bytes;
}

// Bytes with the length that 255 stands for.
Json LengthContent(const PackedSurface& surface, const std::vector<float>& lengths_m, int frames,
                   PackedArrays& arrays) {
  const float most_m = lengths_m.empty() ? 0.0f : std::ranges::max(lengths_m);
  return {{"most_m", most_m},
          {"values", arrays.On(surface, LengthBytes(lengths_m, most_m), frames)}};
}

// Per frame and vertex.
struct VertexColors {
  std::vector<float> errors_m;
  std::vector<std::uint8_t> visible;
};

// Errors against the true surface, and whether the camera sees where each vertex belongs.
VertexColors CompareWithTruth(const OpenedRun& run, const std::vector<int>& frames,
                              const ThinnedMesh& mesh) {
  VertexColors colors;
  const TriangleMesh& true_rest = run.sequence->true_rest_mesh();
  const RestCorrespondence correspondence(run.estimate->rest_mesh(), true_rest);
  const PinholeCamera& camera = run.sequence->info().camera;
  ZBuffer zbuffer(camera);
  for (const int frame : frames) {
    ThrowIfInterrupted();
    const std::vector<Vector3f> true_vertices = run.sequence->ReadTrueVertices(frame);
    const std::vector<Vector3f> truth = mesh.Of(correspondence.TruePositions(true_vertices));
    const std::vector<Vector3f> estimate = mesh.Of(run.estimate->ReadVertices(frame));
    for (const double error_m : VertexErrors(estimate, truth))
      colors.errors_m.push_back(static_cast<float>(error_m));
    const DepthImage& rendered = zbuffer.Render(true_vertices, true_rest.triangles);
    for (const bool visible : VisiblePoints(truth, rendered, camera, kVisibleWithin_m))
      colors.visible.push_back(visible ? 1 : 0);
  }
  return colors;
}

std::vector<float> EstimatedJoints(const EstimateReader& estimate) {
  std::vector<float> values;
  for (const FrameEstimate& frame : estimate.frames()) {
    for (const Vector3d& joint : frame.joints) {
      for (int axis = 0; axis < 3; ++axis) values.push_back(static_cast<float>(joint[axis]));
    }
  }
  return values;
}

// Of each joint of each frame the lower triangle L of C = L Lᵀ, row by row, metres; NaN where the
// tracker gave no covariance C. L carries the unit sphere to the ellipsoid of one standard
// deviation.
std::vector<float> CovarianceFactors(const EstimateReader& estimate) {
  std::vector<float> values;
  for (const FrameEstimate& frame : estimate.frames()) {
    for (std::size_t joint = 0; joint < frame.joints.size(); ++joint) {
      Matrix3<double> factor = Matrix3<double>::Constant(NAN);
      if (frame.has_covariances()) {
        const Eigen::LLT<Matrix3<double>> cholesky(frame.covariance_m2(joint));
        if (cholesky.info() == Eigen::Success) factor = cholesky.matrixL();
      }
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column <= row; ++column)
          values.push_back(static_cast<float>(factor(row, column)));
      }
    }
  }
  return values;
}

// Numbers per frame, in the catalogue's units.
Json SeriesContent(const RunRecord& record, PackedArrays& arrays) {
  Json list = Json::array();
  for (const auto& [key, stored] : record.frames) {
    const Metric metric = FindMetric(key);
    std::vector<float> values;
    for (const double value : stored) values.push_back(static_cast<float>(value * metric.scale));
    list.push_back({{"key", key},
                    {"label", metric.label},
                    {"unit", metric.unit},
                    {"definition", metric.definition},
                    {"values", arrays.Floats(values, static_cast<int>(values.size()))}});
  }
  return list;
}

// Frames that ended otherwise than converged, with the reason.
Json OutcomeContent(const EstimateReader& estimate) {
  Json outcomes = Json::object();
  for (std::size_t i = 0; i < estimate.frames().size(); ++i) {
    const FrameEstimate& frame = estimate.frames()[i];
    if (frame.outcome == Outcome::kConverged && frame.message.empty()) continue;
    outcomes[std::to_string(i)] = frame.message.empty()
                                      ? std::string(Name(frame.outcome))
                                      : fmt::format("{}: {}", Name(frame.outcome), frame.message);
  }
  return outcomes;
}

// Names and shares of the causes that hold some of the error, the largest first.
Json CauseContent(const Diagnosis& diagnosis) {
  std::vector<int> order;
  for (int cause = 0; cause < kCauseCount; ++cause) {
    if (diagnosis.shares[cause] > 0.0) order.push_back(cause);
  }
  std::ranges::stable_sort(order, std::greater{},
                           [&](int cause) { return diagnosis.shares[cause]; });
  Json causes = Json::array();
  for (const int cause : order) {
    causes.push_back({{"name", Name(static_cast<Cause>(cause))},
                      {"meaning", Meaning(static_cast<Cause>(cause))},
                      {"share", diagnosis.shares[cause]}});
  }
  return causes;
}

Json EventContent(const Diagnosis& diagnosis) {
  Json events = Json::array();
  for (const ErrorEvent& event : diagnosis.events) {
    events.push_back({{"first", event.first},
                      {"last", event.last},
                      {"worst", event.worst},
                      {"cause", Name(event.cause)},
                      {"share", event.share},
                      {"reason", event.reason}});
  }
  return events;
}

OpenedRun OpenRun(const fs::path& folder,
                  std::map<fs::path, std::shared_ptr<const SequenceReader>>& sequences) {
  OpenedRun run;
  run.folder = fs::absolute(folder).lexically_normal();
  if (!run.folder.has_filename()) run.folder = run.folder.parent_path();
  const fs::path experiment = run.folder.parent_path();
  run.record = ReadRunRecord(experiment, run.folder.filename().string());
  if (run.record.frames.empty()) {
    throw DataError(
        fmt::format("{}: expected a tracking run, found a run without frames ({})", folder.string(),
                    run.record.method.empty() ? "no method" : "method " + run.record.method));
  }
  run.estimate = std::make_shared<const EstimateReader>(run.folder / "estimate");
  run.sequence_folder = (experiment / run.record.sequence_folder).lexically_normal();
  std::shared_ptr<const SequenceReader>& sequence = sequences[run.sequence_folder];
  if (!sequence) sequence = std::make_shared<const SequenceReader>(run.sequence_folder);
  run.sequence = sequence;
  run.diagnosis = Diagnose(*run.sequence, *run.estimate);
  return run;
}

}  // namespace

int OpenedRun::frame_count() const {
  return std::min(sequence->info().frames, static_cast<int>(estimate->frames().size()));
}

std::vector<OpenedRun> OpenRuns(const std::vector<fs::path>& run_folders) {
  std::map<fs::path, std::shared_ptr<const SequenceReader>> sequences;
  std::vector<OpenedRun> runs;
  for (const fs::path& folder : run_folders) runs.push_back(OpenRun(folder, sequences));
  return runs;
}

Json SequenceContent(const OpenedRun& run, const PageFrame& page, PackedArrays& arrays) {
  const SequenceInfo& info = run.sequence->info();
  const std::vector<int> frames = FramesOf(run, page);
  Json content = {{"scene", run.record.scene},
                  {"hash", run.record.sequence_hash},
                  {"fps", info.fps},
                  {"frames", info.frames},
                  {"camera", CameraContent(info.camera)},
                  {"depth", DepthContent(run, frames, arrays)}};
  if (!info.joints.empty()) {
    content["joints"] = {{"names", info.joints},
                         {"positions", arrays.Floats(TrueJoints(*run.sequence), info.frames)}};
  }
  if (info.surface) content["truth"] = TrueSurface(run, frames, page, arrays);
  if (info.own_surfaces) content["truth"] = OwnTrueSurface(run, frames, page, arrays);
  return content;
}

Json RunContent(const OpenedRun& run, int sequence, const PageFrame& page, PackedArrays& arrays) {
  const std::vector<int> frames = FramesOf(run, page);
  const auto count = static_cast<int>(frames.size());
  const TriangleMesh& rest = run.estimate->rest_mesh();
  const ThinnedMesh mesh = Thinned(rest, page.most_vertices);
  std::vector<std::uint16_t> positions;
  for (const int frame : frames)
    Append(page.grid.Quantised(mesh.Of(run.estimate->ReadVertices(frame))), positions);
  std::vector<float> template_positions;
  for (const Vector3f& vertex : mesh.Of(rest.vertices))
    template_positions.insert(template_positions.end(), {vertex.x(), vertex.y(), vertex.z()});
  const PackedSurface surface = arrays.Surface(mesh.triangles, mesh.kept.size());
  Json content = {{"id", run.record.run_id},
                  {"method", run.record.method},
                  {"variant", run.record.variant},
                  {"sequence", sequence},
                  {"frames", run.frame_count()},
                  {"surface",
                   {{"vertices", rest.vertices.size()},
                    {"shown", mesh.kept.size()},
                    {"triangles", surface.triangles},
                    {"positions", arrays.On(surface, positions, count)},
                    {"template", arrays.Floats(template_positions, 1)}}},
                  {"joints", arrays.Floats(EstimatedJoints(*run.estimate),
                                           static_cast<int>(run.estimate->frames().size()))},
                  {"series", SeriesContent(run.record, arrays)},
                  {"outcomes", OutcomeContent(*run.estimate)},
                  {"causes", CauseContent(run.diagnosis)},
                  {"events", EventContent(run.diagnosis)},
                  {"lost", run.diagnosis.lost_frames}};
  if (std::ranges::any_of(run.estimate->frames(), &FrameEstimate::has_covariances)) {
    content["uncertainty"] = arrays.Floats(CovarianceFactors(*run.estimate),
                                           static_cast<int>(run.estimate->frames().size()));
  }
  if (run.sequence->info().surface) {
    const VertexColors colors = CompareWithTruth(run, frames, mesh);
    content["surface"]["error"] = LengthContent(surface, colors.errors_m, count, arrays);
    content["surface"]["visible"] = arrays.On(surface, colors.visible, count);
  }
  if (run.sequence->info().subject) {
    const BonePlacement bones(mesh.Of(rest.vertices), run.sequence->subject());
    content["surface"]["bone"] = arrays.Bytes(bones.BoneOfVertex());
    std::vector<float> warps_m;
    for (const int frame : frames)
      Append(bones.Warps(mesh.Of(run.estimate->ReadVertices(frame))), warps_m);
    content["surface"]["warp"] = LengthContent(surface, warps_m, count, arrays);
  }
  return content;
}

Eigen::AlignedBox3f BoundingBoxOf(const std::vector<OpenedRun>& runs,
                                  const std::vector<int>& frames) {
  Eigen::AlignedBox3f box;
  for (const OpenedRun& run : runs) {
    for (const int frame : frames) {
      if (frame >= run.frame_count()) continue;
      box.extend(BoundingBox(run.estimate->ReadVertices(frame)));
      if (run.sequence->info().surface)
        box.extend(BoundingBox(run.sequence->ReadTrueVertices(frame)));
      if (run.sequence->info().own_surfaces)
        box.extend(BoundingBox(run.sequence->ReadTrueSurface(frame).vertices));
    }
  }
  return box;
}

double ErrorScaleOf(const std::vector<OpenedRun>& runs, const std::vector<int>& frames) {
  constexpr std::size_t kSampledFrames = 30;
  std::vector<double> errors_m;
  for (const OpenedRun& run : runs) {
    if (!run.sequence->info().surface) continue;
    const RestCorrespondence correspondence(run.estimate->rest_mesh(),
                                            run.sequence->true_rest_mesh());
    const std::size_t every = std::max<std::size_t>(1, frames.size() / kSampledFrames);
    for (std::size_t i = 0; i < frames.size(); i += every) {
      if (frames[i] >= run.frame_count()) continue;
      const std::vector<Vector3f> estimate = run.estimate->ReadVertices(frames[i]);
      const std::vector<double> of_frame = VertexErrors(
          estimate, correspondence.TruePositions(run.sequence->ReadTrueVertices(frames[i])));
      for (std::size_t v = 0; v < of_frame.size(); ++v) {
        if (run.sequence->info().camera.InView(estimate[v])) errors_m.push_back(of_frame[v]);
      }
    }
  }
  return ErrorScaleEnd(std::move(errors_m), kSmallestErrorScale_m);
}

}  // namespace vitruvia
