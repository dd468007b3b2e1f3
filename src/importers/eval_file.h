// Files of the Stanford EVAL data set (Ganapathi, Plagemann, Koller and Thrun 2012): frames of one
// size, packed, little-endian.
//
//   byte        0  int32    magic, the same in all frames
//               4  int32    number of the frame
//               8  float32  [240][320][3] points, metres: x right, y up, z backwards, so negative
//                           before the camera; (0, 0, 0): nothing measured
//         921 608  int32    number of markers, then 32 × { char name[256], float32 [3] }
//         930 188  int32    number of joints, then 32 × { int32 id, float32 [3] }
//         930 704           the next frame
//
// Only as many markers and joints as the count says are valid; one at (0, 0, 0) was not seen.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "geometry/mesh.h"

namespace vitruvia {

inline constexpr int kEvalWidth = 320, kEvalHeight = 240;
inline constexpr int kEvalEntries = 32;  // room for markers, and for joints
inline constexpr std::size_t kEvalNameBytes = 256;
inline constexpr std::size_t kEvalFrameBytes = 930704;

// In the camera frame of this code (geometry/camera.h): x right, y down, z forward, metres.
struct EvalFrame {
  int number = 0;
  std::vector<Vector3f> points;             // in row-major order; zero where nothing was measured
  std::map<std::string, Vector3d> markers;  // those that were seen
  std::map<int, Vector3d> joints;           // by id, those that were seen
};

// Reads frames on demand. All members throw DataError naming the file, the frame and the byte, what
// was expected and what was found: a size that is not a multiple of the frame size, a different
// magic number, too many markers or joints, a duplicate name or id, a number that is not finite, a
// point behind the camera.
class EvalFile {
 public:
  explicit EvalFile(std::filesystem::path file);

  const std::filesystem::path& path() const { return file_; }
  int frames() const { return frames_; }
  EvalFrame ReadFrame(int frame) const;

 private:
  std::filesystem::path file_;
  int frames_ = 0;
  int magic_ = 0;  // of the first frame
};

}  // namespace vitruvia
