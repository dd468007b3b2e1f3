#include "records/estimate.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <fstream>

#include "body/skeleton.h"
#include "core/error.h"
#include "core/files.h"
#include "core/write_failure.h"
#include "geometry/mesh_io.h"
#include "math/rigid.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

static_assert(std::endian::native == std::endian::little, "vertices.bin is little-endian");
static_assert(sizeof(Vector3f) == 3 * sizeof(float), "vertices.bin holds packed vectors");

constexpr const char* kIndexFile = "estimate.json";
constexpr const char* kVerticesFile = "vertices.bin";
constexpr std::size_t kNumbersOfCovariance = 6;
constexpr const char* kMeshFile = "mesh.ply";

// The largest ‖RᵀR − I‖ (Frobenius) of any bone.
double RotationDrift(const BoneTransforms& bones) {
  double largest = 0.0;
  for (const Rigidd& bone : bones) {
    const Matrix3<double> product = bone.rotation.transpose() * bone.rotation;
    largest = std::max(largest, (product - Matrix3<double>::Identity()).norm());
  }
  return largest;
}

// Trackers say −1 for what they do not compute.
double AbsentIfNegative(double value) { return value < 0.0 ? kAbsent : value; }

// The upper triangles, row by row.
std::vector<double> Packed(const std::vector<Matrix3<double>>& matrices) {
  std::vector<double> packed;
  for (const Matrix3<double>& m : matrices)
    packed.insert(packed.end(), {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)});
  return packed;
}

std::vector<std::string> NamesOf(const std::vector<bool>& joints) {
  std::vector<std::string> names;
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (joints[j]) names.emplace_back(Bones()[j].joint);
  return names;
}

FrameEstimate EstimateOf(const TrackResult& result, double frame_ms) {
  return {result.outcome,
          result.message,
          result.iterations,
          frame_ms,
          result.step_ms,
          result.energies,
          AbsentIfNegative(result.condition),
          AbsentIfNegative(result.energy_rise),
          RotationDrift(result.camera_from_rest),
          result.joints,
          Packed(result.joint_covariances),
          NamesOf(result.unreliable_joints),
          AbsentIfNegative(result.weak_directions),
          result.weak_directions < 0 ? kAbsent : result.agreeing_digits};
}

std::size_t BytesPerFrame(const TriangleMesh& mesh) {
  return mesh.vertices.size() * sizeof(Vector3f);
}

}  // namespace

void FrameEstimate::Describe(Fields& f) {
  f.Choice("outcome", outcome,
           {{Name(Outcome::kConverged), Outcome::kConverged},
            {Name(Outcome::kIterationLimit), Outcome::kIterationLimit},
            {Name(Outcome::kLost), Outcome::kLost},
            {Name(Outcome::kNoData), Outcome::kNoData}},
           {.meaning = "how tracking of the frame ended"});
  f.Text("message", message, {.meaning = "why tracking ended so, for people; empty if converged"});
  f.Integer("iterations", iterations, {.meaning = "iterations of the frame"});
  f.Number("frame_ms", frame_ms,
           {.meaning = "wall-clock time of tracking the frame", .unit = "ms"});
  f.NamedNumbers("step_ms", step_ms,
                 {.meaning = "time of each step, summed over the frame's iterations, in the "
                             "method's order",
                  .unit = "ms"});
  f.NamedNumbers(
      "energies", energies,
      {.meaning = "energy of each term at the last linearisation, weighted as minimised"});
  f.Number("condition", condition,
           {.meaning = "condition number of the last normal equations, infinite if they are "
                       "singular; absent for methods that do not estimate it",
            .optional = true,
            .infinite = true});
  f.Number("energy_rise", energy_rise,
           {.meaning = "largest share by which a step raised the energy, its correspondences kept; "
                       "absent if that was not watched",
            .optional = true});
  f.Number("rotation_drift", rotation_drift,
           {.meaning = "largest ‖RᵀR − I‖ of any bone; 0 for methods without bones"});
  f.Points("joints", joints, {.meaning = "proximal end of each bone, camera frame", .unit = "m"});
  f.NumberList("joint_covariances_m2", joint_covariances_m2,
               {.meaning = "covariance of each joint, camera frame: xx, xy, xz, yy, yz, zz of one "
                           "joint after the other; absent where the tracker gives none",
                .unit = "m²",
                .optional = true});
  f.Texts("unreliable_joints", unreliable_joints,
          {.meaning = "joints that the tracker says not to rely on; absent where there are none",
           .optional = true});
  f.Number("weak_directions", weak_directions,
           {.meaning = "eigenvalues of the last normal equations below 1e-6 of the largest; absent "
                       "if that was not checked",
            .optional = true});
  f.Number("agreeing_digits", agreeing_digits,
           {.meaning = "digits in which the last step agrees with a slow solution of the same "
                       "equations; absent if that was not checked",
            .optional = true});
}

std::string FrameEstimate::Problem() const {
  const std::size_t expected = kNumbersOfCovariance * joints.size();
  if (joint_covariances_m2.empty() || joint_covariances_m2.size() == expected) return "";
  return fmt::format("joint_covariances_m2: expected {} numbers for {} joints, got {}", expected,
                     joints.size(), joint_covariances_m2.size());
}

Matrix3<double> FrameEstimate::covariance_m2(std::size_t joint) const {
  const double* c = joint_covariances_m2.data() + kNumbersOfCovariance * joint;
  Matrix3<double> covariance;
  covariance << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5];
  return covariance;
}

void EstimateFile::Describe(Fields& f) {
  f.Integer("vertex_count", vertex_count,
            {.meaning = "vertices of mesh.ply and of each frame of vertices.bin"});
  f.Number("tracker_memory_mb", tracker_memory_mb,
           {.meaning = "the most memory that the tracker held; absent if it was not measured",
            .unit = "MB (10⁶ bytes)",
            .optional = true});
  f.List("frames", frames, {.meaning = "one estimate for each frame of the sequence"});
}

// Version 1 wrote null for an infinite condition and −1 for what was not computed.
void EstimateFile::Upgrade(Json& file, int /*version*/) {
  const auto frames = file.find("frames");
  if (frames == file.end() || !frames->is_array()) return;
  for (Json& frame : *frames) {
    if (!frame.is_object()) continue;
    for (const char* key : {"condition", "energy_rise"}) {
      const auto found = frame.find(key);
      if (found == frame.end()) continue;
      if (found->is_null()) {
        *found = kInfinityText;
      } else if (*found == -1.0) {
        frame.erase(found);
      }
    }
  }
}

struct EstimateWriter::State {
  State(fs::path destination, const TriangleMesh& rest_mesh)
      : folder(std::move(destination), kIndexFile),
        vertex_count(rest_mesh.vertices.size()),
        vertices(folder.path() / kVerticesFile, std::ios::binary) {
    file.vertex_count = static_cast<int>(vertex_count);
    RequireWritten();
    WriteMesh(folder.path() / kMeshFile, rest_mesh);
  }

  void RequireWritten() const {
    if (!vertices) FailToWrite(folder.path() / kVerticesFile, errno);
  }

  StagedFolder folder;
  std::size_t vertex_count;
  std::ofstream vertices;
  EstimateFile file;
};

EstimateWriter::EstimateWriter(fs::path folder, const TriangleMesh& rest_mesh)
    : state_(std::make_unique<State>(std::move(folder), rest_mesh)) {}
EstimateWriter::~EstimateWriter() = default;

void EstimateWriter::Append(const TrackResult& result, double frame_ms) {
  const std::size_t index = state_->file.frames.size();
  Require(result.vertices.size() == state_->vertex_count, "frame {}: expected {} vertices, got {}",
          index, state_->vertex_count, result.vertices.size());
  for (std::size_t v = 0; v < result.vertices.size(); ++v) {
    Require(result.vertices[v].allFinite(), "frame {}: vertex {} is not finite", index, v);
  }
  const FrameEstimate frame = EstimateOf(result, frame_ms);
  RequireStorable(frame, fmt::format("frame {}: ", index));
  state_->file.frames.push_back(frame);
  state_->vertices.write(reinterpret_cast<const char*>(result.vertices.data()),
                         static_cast<std::streamsize>(state_->vertex_count * sizeof(Vector3f)));
  state_->RequireWritten();
}

void EstimateWriter::Finish(std::optional<double> tracker_memory_mb) {
  state_->vertices.close();
  state_->RequireWritten();
  state_->file.tracker_memory_mb = tracker_memory_mb.value_or(kAbsent);
  constexpr int kOneLine = -1;
  WriteStored(state_->folder.path() / kIndexFile, std::move(state_->file), kOneLine);
  state_->folder.Commit();
}

std::string MissingEstimateFile(const fs::path& folder) {
  if (!fs::exists(folder)) return "";
  for (const char* file : {kIndexFile, kMeshFile, kVerticesFile}) {
    if (!fs::exists(folder / file)) return fmt::format("{}: is gone", (folder / file).string());
  }
  return "";
}

EstimateReader::EstimateReader(fs::path folder) : folder_(std::move(folder)) {
  const fs::path index_file = folder_ / kIndexFile;
  file_ = ReadStored<EstimateFile>(index_file);
  rest_mesh_ = ReadMesh(folder_ / kMeshFile);
  if (file_.vertex_count != static_cast<int>(rest_mesh_.vertices.size())) {
    throw DataError(fmt::format("{}: vertex_count: expected the {} vertices of {}, got {}",
                                index_file.string(), rest_mesh_.vertices.size(), kMeshFile,
                                file_.vertex_count));
  }
  const fs::path vertices_file = folder_ / kVerticesFile;
  std::error_code error;
  const auto size = fs::file_size(vertices_file, error);
  if (error) throw DataError(fmt::format("{}: {}", vertices_file.string(), error.message()));
  const std::size_t expected = frames().size() * BytesPerFrame(rest_mesh_);
  if (size != expected) {
    throw DataError(fmt::format("{}: expected {} bytes ({} frames × {} vertices × 12), got {}",
                                vertices_file.string(), expected, frames().size(),
                                rest_mesh_.vertices.size(), size));
  }
}

std::optional<double> EstimateReader::tracker_memory_mb() const {
  if (std::isnan(file_.tracker_memory_mb)) return std::nullopt;
  return file_.tracker_memory_mb;
}

std::vector<Vector3f> EstimateReader::ReadVertices(int frame) const {
  Require(frame >= 0 && frame < static_cast<int>(frames().size()), "frame {} of {}", frame,
          frames().size());
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
