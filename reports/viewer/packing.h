// Numbers of a page as text: quantised, compressed (zlib) and in base64, each array in an element
// of its own. viewer_data.js unpacks them.
#pragma once

#include <cstdint>
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

// How an array's numbers are stored. All are reversible.
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
  // `frames` arrays of equal length, one after the other. Each returns how the page refers to the
  // array: {"id", "type", "coding", "frames", "length"}.
  nlohmann::json Bytes(std::vector<std::uint8_t> values, int frames, Coding coding);
  nlohmann::json Words(std::vector<std::uint16_t> values, int frames, Coding coding);
  nlohmann::json Indices(const std::vector<std::uint32_t>& values);
  nlohmann::json Floats(const std::vector<float>& values, int frames);

  // The elements of the page that hold the arrays, compressed on all cores.
  std::string Html() const;

 private:
  nlohmann::json Add(std::vector<std::uint8_t> coded, const char* type, Coding coding, int frames,
                     std::size_t count);

  std::vector<std::vector<std::uint8_t>> arrays_;
};

}  // namespace vitruvia
