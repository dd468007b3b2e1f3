#include "records/estimate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <fstream>

#include "config/json_node.h"
#include "core/files.h"
#include "core/write_failure.h"
#include "geometry/mesh_io.h"

namespace vitruvia {
namespace fs = std::filesystem;
using Json = nlohmann::json;
namespace {

static_assert(std::endian::native == std::endian::little, "vertices.bin is little-endian");
static_assert(sizeof(Vector3f) == 3 * sizeof(float), "vertices.bin holds packed vectors");

constexpr const char* kFormat = "vitruvia-estimate";
constexpr int kVersion = 1;
constexpr const char* kIndexFile = "estimate.json";
constexpr const char* kVerticesFile = "vertices.bin";
constexpr const char* kMeshFile = "mesh.ply";
constexpr std::array kOutcomes = {Outcome::kConverged, Outcome::kIterationLimit, Outcome::kLost,
                                  Outcome::kNoData};

Outcome ParseOutcome(const JsonNode& node) {
  const std::string name = node.Text();
  for (const Outcome outcome : kOutcomes) {
    if (name == Name(outcome)) return outcome;
  }
  node.Fail("expected the name of an outcome");
}

// A list of pairs, since the order of steps and terms means something and an object has none.
Json PairsOf(const std::vector<NamedValue>& values, const std::string& where) {
  Json pairs = Json::array();
  for (const NamedValue& v : values) {
    pairs.push_back(Json::array({v.name, Finite(v.value, where + v.name)}));
  }
  return pairs;
}

std::vector<NamedValue> ParsePairs(const JsonNode& node) {
  return node.List([](const JsonNode& pair) {
    if (!pair.json().is_array() || pair.json().size() != 2 || !pair.json()[0].is_string() ||
        !pair.json()[1].is_number()) {
      pair.Fail("expected a name and a number");
    }
    return NamedValue{pair.json()[0].get<std::string>(), pair.json()[1].get<double>()};
  });
}

Vector3<double> ParsePoint(const JsonNode& node) {
  const std::vector<double> xyz = node.Numbers();
  if (xyz.size() != 3) node.Fail("expected 3 numbers");
  return {xyz[0], xyz[1], xyz[2]};
}

// The largest ‖RᵀR − I‖ (Frobenius) of any bone.
double RotationDrift(const BoneTransforms& bones) {
  double largest = 0.0;
  for (const Rigidd& bone : bones) {
    const Matrix3<double> product = bone.rotation.transpose() * bone.rotation;
    largest = std::max(largest, (product - Matrix3<double>::Identity()).norm());
  }
  return largest;
}

Json JsonOfFrame(const TrackResult& result, double frame_ms, int index) {
  const std::string where = fmt::format("frame {}: ", index);
  Json joints = Json::array();
  for (std::size_t j = 0; j < result.joints.size(); ++j) {
    const auto& p = result.joints[j];
    const std::string joint = fmt::format("{}joint {}", where, j);
    joints.push_back({Finite(p.x(), joint), Finite(p.y(), joint), Finite(p.z(), joint)});
  }
  // Singular normal equations have an infinite condition number: a fact, stored as null.
  const bool singular = std::isinf(result.condition);
  return {{"outcome", Name(result.outcome)},
          {"message", result.message},
          {"iterations", result.iterations},
          {"frame_ms", Finite(frame_ms, where + "frame_ms")},
          {"step_ms", PairsOf(result.step_ms, where + "step_ms ")},
          {"energies", PairsOf(result.energies, where + "energy ")},
          {"condition", singular ? Json(nullptr) : Finite(result.condition, where + "condition")},
          {"energy_rise", Finite(result.energy_rise, where + "energy_rise")},
          {"rotation_drift", Finite(RotationDrift(result.camera_from_rest), where + "drift")},
          {"joints", joints}};
}

FrameEstimate ParseFrame(const JsonNode& node) {
  FrameEstimate frame;
  frame.outcome = ParseOutcome(node.At("outcome"));
  frame.message = node.At("message").Text();
  frame.iterations = node.At("iterations").Integer();
  frame.frame_ms = node.At("frame_ms").Number();
  frame.step_ms = ParsePairs(node.At("step_ms"));
  frame.energies = ParsePairs(node.At("energies"));
  frame.condition = node.At("condition").NumberOr(std::numeric_limits<double>::infinity());
  if (node.json().contains("rotation_drift")) {  // older estimates have none
    frame.rotation_drift = node.At("rotation_drift").Number();
  }
  if (node.json().contains("energy_rise")) frame.energy_rise = node.At("energy_rise").Number();
  frame.joints = node.At("joints").List(ParsePoint);
  for (double* number : {&frame.condition, &frame.energy_rise}) {
    if (*number < 0.0) *number = kNoValue;  // not computed
  }
  return frame;
}

std::size_t BytesPerFrame(const TriangleMesh& mesh) {
  return mesh.vertices.size() * sizeof(Vector3f);
}

}  // namespace

struct EstimateWriter::State {
  State(fs::path destination, const TriangleMesh& rest_mesh)
      : folder(std::move(destination), kIndexFile),
        vertex_count(rest_mesh.vertices.size()),
        vertices(folder.path() / kVerticesFile, std::ios::binary) {
    RequireWritten();
    WriteMesh(folder.path() / kMeshFile, rest_mesh);
  }

  void RequireWritten() const {
    if (!vertices) FailToWrite(folder.path() / kVerticesFile, errno);
  }

  StagedFolder folder;
  std::size_t vertex_count;
  std::ofstream vertices;
  Json frames = Json::array();
};

EstimateWriter::EstimateWriter(fs::path folder, const TriangleMesh& rest_mesh)
    : state_(std::make_unique<State>(std::move(folder), rest_mesh)) {}
EstimateWriter::~EstimateWriter() = default;

void EstimateWriter::Append(const TrackResult& result, double frame_ms) {
  const int index = static_cast<int>(state_->frames.size());
  Require(result.vertices.size() == state_->vertex_count, "frame {}: expected {} vertices, got {}",
          index, state_->vertex_count, result.vertices.size());
  for (std::size_t v = 0; v < result.vertices.size(); ++v) {
    Require(result.vertices[v].allFinite(), "frame {}: vertex {} is not finite", index, v);
  }
  state_->frames.push_back(JsonOfFrame(result, frame_ms, index));
  state_->vertices.write(reinterpret_cast<const char*>(result.vertices.data()),
                         static_cast<std::streamsize>(state_->vertex_count * sizeof(Vector3f)));
  state_->RequireWritten();
}

void EstimateWriter::Finish(std::optional<double> tracker_memory_mb) {
  state_->vertices.close();
  state_->RequireWritten();
  Json index = {{"format", kFormat},
                {"version", kVersion},
                {"vertex_count", state_->vertex_count},
                {"frames", std::move(state_->frames)}};
  if (tracker_memory_mb) index["tracker_memory_mb"] = *tracker_memory_mb;
  WriteWholeFile(state_->folder.path() / kIndexFile, index.dump() + "\n");
  state_->folder.Commit();
}

EstimateReader::EstimateReader(fs::path folder) : folder_(std::move(folder)) {
  const fs::path index_file = folder_ / kIndexFile;
  const Json index = ReadStoredJson(index_file);
  const JsonNode node(index, index_file.string());
  if (node.At("format").Text() != kFormat) node.At("format").Fail("expected \"vitruvia-estimate\"");
  if (node.At("version").Integer() != kVersion) node.At("version").Fail("expected version 1");
  frames_ = node.At("frames").List(ParseFrame);
  if (index.contains("tracker_memory_mb")) {
    tracker_memory_mb_ = node.At("tracker_memory_mb").Number();
  }
  rest_mesh_ = ReadMesh(folder_ / kMeshFile);
  if (node.At("vertex_count").Integer() != static_cast<int>(rest_mesh_.vertices.size())) {
    node.At("vertex_count")
        .Fail(fmt::format("expected the {} vertices of {}", rest_mesh_.vertices.size(), kMeshFile));
  }
  const fs::path vertices_file = folder_ / kVerticesFile;
  std::error_code error;
  const auto size = fs::file_size(vertices_file, error);
  if (error) throw DataError(fmt::format("{}: {}", vertices_file.string(), error.message()));
  const std::size_t expected = frames_.size() * BytesPerFrame(rest_mesh_);
  if (size != expected) {
    throw DataError(fmt::format("{}: expected {} bytes ({} frames × {} vertices × 12), got {}",
                                vertices_file.string(), expected, frames_.size(),
                                rest_mesh_.vertices.size(), size));
  }
}

std::vector<Vector3f> EstimateReader::ReadVertices(int frame) const {
  Require(frame >= 0 && frame < static_cast<int>(frames_.size()), "frame {} of {}", frame,
          frames_.size());
  const fs::path file = folder_ / kVerticesFile;
  std::ifstream stream(file, std::ios::binary);
  std::vector<Vector3f> vertices(rest_mesh_.vertices.size());
  const std::size_t bytes = BytesPerFrame(rest_mesh_);
  stream.seekg(static_cast<std::streamoff>(bytes * static_cast<std::size_t>(frame)));
  stream.read(reinterpret_cast<char*>(vertices.data()), static_cast<std::streamsize>(bytes));
  if (!stream) throw DataError(fmt::format("{}: frame {} cannot be read", file.string(), frame));
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (!vertices[v].allFinite()) {
      throw DataError(
          fmt::format("{}: frame {}: vertex {} is not finite", file.string(), frame, v));
    }
  }
  return vertices;
}

}  // namespace vitruvia
