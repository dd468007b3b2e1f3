// A tracker's raw estimate of a sequence, from which every metric can be recomputed.
//
//   estimate.json   EstimateFile (docs/stored_data.md)
//   vertices.bin    float32 [frames][vertices][3], camera frame, metres, little-endian
//   mesh.ply        triangles and rest pose of the tracked surface
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/stored_data.h"
#include "tracking/tracker.h"

namespace vitruvia {

struct FrameEstimate {
  Outcome outcome = Outcome::kNoData;
  std::string message;
  int iterations = 0;
  double frame_ms = 0.0;  // wall clock of TrackFrame only
  std::vector<NamedValue> step_ms, energies;
  double condition = kAbsent;    // of the normal equations; infinite if they are singular
  double energy_rise = kAbsent;  // see TrackResult
  double rotation_drift = 0.0;  // largest ‖RᵀR − I‖ of any bone; 0 for methods without bones
  std::vector<Vector3<double>> joints;  // camera frame, metres
  // Covariance of each joint, m²: xx, xy, xz, yy, yz, zz; empty if the tracker gives none.
  std::vector<double> joint_covariances_m2{};
  std::vector<std::string> unreliable_joints{};                 // by name
  double weak_directions = kAbsent, agreeing_digits = kAbsent;  // see TrackResult

  bool has_covariances() const { return !joint_covariances_m2.empty(); }
  Matrix3<double> covariance_m2(std::size_t joint) const;
  void Describe(Fields& fields);
  std::string Problem() const;
};

struct EstimateFile {
  static constexpr StoredFormat kFormat{"vitruvia-estimate", 2, 1, "run the experiment again"};

  int vertex_count = 0;
  double tracker_memory_mb = kAbsent;  // MB of 10⁶ bytes
  std::vector<FrameEstimate> frames;

  void Describe(Fields& fields);
  static void Upgrade(Json& file, int version);
};

class EstimateWriter {
 public:
  EstimateWriter(std::filesystem::path folder, const TriangleMesh& rest_mesh);
  ~EstimateWriter();
  // std::invalid_argument naming frame and value if the result cannot be stored.
  void Append(const TrackResult& result, double frame_ms);
  // Moves the folder into place; if it is not called, no files remain. `tracker_memory_mb`: the
  // tracker's peak memory, in MB of 10⁶ bytes.
  void Finish(std::optional<double> tracker_memory_mb = std::nullopt);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// What a folder of an estimate lacks, from the presence of its files alone; "" if nothing, or if
// there is no such folder: a run's estimate may be deleted to save space.
std::string MissingEstimateFile(const std::filesystem::path& folder);

// Throws DataError if a file is missing, damaged or of the wrong size.
class EstimateReader {
 public:
  explicit EstimateReader(std::filesystem::path folder);
  const TriangleMesh& rest_mesh() const { return rest_mesh_; }
  const std::vector<FrameEstimate>& frames() const { return file_.frames; }
  std::optional<double> tracker_memory_mb() const;
  std::vector<Vector3f> ReadVertices(int frame) const;

 private:
  std::filesystem::path folder_;
  TriangleMesh rest_mesh_;
  EstimateFile file_;
};

}  // namespace vitruvia
