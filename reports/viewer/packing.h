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

// What is finer is noise to the eye and does not compress.
inline constexpr float kFinestStep_m = 1e-4f;

// Positions on a cubic grid: 16 bits for each coordinate.
struct PositionGrid {
  Vector3f origin = Vector3f::Zero();  // metres
  float step_m = 0.0f;

  // The finest grid that holds the box, but no finer than kFinestStep_m. The box must not be empty.
  static PositionGrid Over(const Eigen::AlignedBox3f& box);
  // Coordinates x, y, z of each point in turn; points outside are held at the border.
  std::vector<std::uint16_t> Quantised(const std::vector<Vector3f>& points) const;
};

// How an array's numbers are stored. All are reversible.
enum class Coding {
  kPlain,       // as they are
  kBytePlanes,  // 16 bits: all low bytes of a frame, then all high bytes
  // 8 or 16 bits, numbers of a surface's vertices: the change since the frame before, less the mean
  // change of the vertices that stand before this one and share an edge with it; all vertices'
  // first numbers, then all second ones. Parts of a body move together, so that most of it is near
  // 0. 16 bits are in byte planes.
  kSurface,
};

// The vertices of a surface that stand before a vertex and share an edge with it.
class EarlierNeighbours {
 public:
  // An edge counts for a triangle that goes along it from the later vertex to the earlier one: in a
  // closed oriented surface each edge once. A vertex without any has the one before it.
  EarlierNeighbours(const std::vector<Triangle>& triangles, std::size_t vertices);
  std::span<const std::uint32_t> Of(std::size_t vertex) const {
    return std::span(indices_).subspan(begins_[vertex], begins_[vertex + 1] - begins_[vertex]);
  }
  std::size_t vertices() const { return begins_.size() - 1; }

 private:
  std::vector<std::uint32_t> begins_, indices_;
};

// A surface in a page.
struct PackedSurface {
  nlohmann::json triangles;  // see PackedArrays
  EarlierNeighbours neighbours;
};

class PackedArrays {
 public:
  // `frames` arrays of equal length, one after the other. Those of bytes and words are split into
  // chunks of at most `chunk_frames` frames that do not depend on each other, each in an element of
  // its own, so that a page unpacks what it shows. Each function returns how the page refers to the
  // array: {"id", "type", "coding", "frames", "chunk_frames", "length"}, on a surface
  // also "surface", its triangles' id, and "vertices"; chunk k stands in element id + k.
  nlohmann::json Bytes(const std::vector<std::uint8_t>& values);  // one frame
  nlohmann::json Words(const std::vector<std::uint16_t>& values, int frames);
  nlohmann::json Floats(const std::vector<float>& values, int frames);
  PackedSurface Surface(const std::vector<Triangle>& triangles, std::size_t vertices);
  // Equally many numbers for each vertex of the surface.
  nlohmann::json On(const PackedSurface& surface, const std::vector<std::uint8_t>& values,
                    int frames);
  nlohmann::json On(const PackedSurface& surface, const std::vector<std::uint16_t>& values,
                    int frames);

  // The elements of the page that hold the arrays, compressed on all cores.
  std::string Html() const;

 private:
  struct Element {
    std::vector<std::uint8_t> bytes;
    Coding coding;
  };
  // Coded by `coded`(values of a chunk, its frames).
  template <class Number, class Code>
  nlohmann::json Add(const std::vector<Number>& values, int frames, int chunk_frames, Coding coding,
                     const Code& coded);
  template <class Number>
  nlohmann::json AddOn(const PackedSurface& surface, const std::vector<Number>& values, int frames);

  std::vector<Element> elements_;
};

}  // namespace vitruvia
