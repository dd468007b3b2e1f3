// What a tracker said of a sequence, stored raw so that every metric can be computed again.
//
//   estimate.json   format, version, vertex count, and per frame: outcome, message, iterations,
//                   frame_ms, step_ms, energies, energy_rise, condition, joints (camera frame,
//                   metres); tracker_memory_mb
//   vertices.bin    float32 [frames][vertices][3], camera frame, metres, little-endian
//   mesh.ply        triangles and rest pose of the tracked surface
#pragma once

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tracking/tracker.h"

namespace vitruvia {

struct FrameEstimate {
  Outcome outcome = Outcome::kNoData;
  std::string message;
  int iterations = 0;
  double frame_ms = 0.0;  // wall clock round TrackFrame only
  std::vector<NamedValue> step_ms, energies;
  // See TrackResult; NaN where the method computes none.
  double condition = std::numeric_limits<double>::quiet_NaN();
  double energy_rise = std::numeric_limits<double>::quiet_NaN();
  double rotation_drift = 0.0;  // largest ‖RᵀR − I‖ of any bone; 0 for methods without bones
  std::vector<Vector3<double>> joints;
};

class EstimateWriter {
 public:
  EstimateWriter(std::filesystem::path folder, const TriangleMesh& rest_mesh);
  ~EstimateWriter();
  void Append(const TrackResult& result, double frame_ms);
  // Moves the folder into place; without it nothing is left behind. The memory is the most that
  // the tracker held, in MB of 10⁶ bytes.
  void Finish(std::optional<double> tracker_memory_mb = std::nullopt);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Throws DataError if a file is missing, damaged or of the wrong size.
class EstimateReader {
 public:
  explicit EstimateReader(std::filesystem::path folder);
  const TriangleMesh& rest_mesh() const { return rest_mesh_; }
  const std::vector<FrameEstimate>& frames() const { return frames_; }
  std::optional<double> tracker_memory_mb() const { return tracker_memory_mb_; }
  std::vector<Vector3f> ReadVertices(int frame) const;

 private:
  std::filesystem::path folder_;
  TriangleMesh rest_mesh_;
  std::vector<FrameEstimate> frames_;
  std::optional<double> tracker_memory_mb_;
};

}  // namespace vitruvia
