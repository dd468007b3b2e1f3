// Adjacency of faces across edges: the half-edges of a mesh of N-sided faces.
//
// Half-edge f·N + k runs from corner k of face f to its next corner.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace vitruvia {

struct HalfEdges {
  std::vector<int> twin;  // the half-edge on the other side; -1 if there is none, see `problem`
  std::vector<int> edge;  // the edge that a half-edge and its twin share, in order of appearance
  int edge_count = 0;
  bool closed = true;   // every edge belongs to two faces or more
  std::string problem;  // "" for a closed, consistently oriented 2-manifold that uses every vertex
};

// `corners` holds the faces' vertex indices one face after the other.
HalfEdges FindHalfEdges(const std::int32_t* corners, std::size_t face_count, int corners_per_face,
                        std::size_t vertex_count);

template <std::size_t N>
HalfEdges FindHalfEdges(const std::vector<std::array<std::int32_t, N>>& faces,
                        std::size_t vertex_count) {
  return FindHalfEdges(faces.empty() ? nullptr : faces.front().data(), faces.size(),
                       static_cast<int>(N), vertex_count);
}

}  // namespace vitruvia
