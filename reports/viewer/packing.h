// Numbers of a page as text: quantised, compressed (zlib) and in base64. viewer_data.js unpacks
// them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "geometry/mesh.h"

namespace vitruvia {

// Positions on a cubic grid: 16 bits for each coordinate.
struct PositionGrid {
  Vector3f origin = Vector3f::Zero();  // metres
  float step_m = 0.0f;

  // The finest grid that holds the box, but no finer than 0.1 mm: what is finer is noise to the eye
  // and does not compress. The box must not be empty.
  static PositionGrid Over(const Eigen::AlignedBox3f& box);
  // Coordinates x, y, z of each point in turn; points outside are held at the border.
  std::vector<std::uint16_t> Quantised(const std::vector<Vector3f>& points) const;
};

// How an array's numbers are stored. All are reversible. Frames are coded in chunks that do not
// depend on each other.
enum class Coding {
  kPlain,         // as they are
  kBytePlanes,    // 16 bits: all low bytes of a frame, then all high bytes
  kFrameChanges,  // 8 bits: each frame less the one before
  // 16 bits, positions: the change of a coordinate's change from frame to frame, less that of the
  // vertex before, coordinate by coordinate, in byte planes. A body's parts move smoothly and
  // together, so that most of these numbers are near 0.
  kMotion,
};

class PackedArrays {
 public:
  // `frames` arrays of equal length, one after the other. Bytes and words are split into chunks of
  // at most `chunk_frames` frames, each in an element of its own, so that a page unpacks what it
  // shows. Each function returns how the page refers to the array: {"id", "type", "coding",
  // "frames", "chunk_frames", "length"}; chunk k stands in element id + k.
  nlohmann::json Bytes(const std::vector<std::uint8_t>& values, int frames, Coding coding);
  nlohmann::json Words(const std::vector<std::uint16_t>& values, int frames, Coding coding);
  nlohmann::json Indices(const std::vector<std::uint32_t>& values);
  nlohmann::json Floats(const std::vector<float>& values, int frames);

  // The elements of the page that hold the arrays, compressed on all cores.
  std::string Html() const;

 private:
  template <class Number>
  nlohmann::json Add(const std::vector<Number>& values, const char* type, Coding coding, int frames,
                     int chunk_frames);

  std::vector<std::vector<std::uint8_t>> arrays_;
};

}  // namespace vitruvia
