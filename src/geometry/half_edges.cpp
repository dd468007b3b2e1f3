#include "geometry/half_edges.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace vitruvia {
namespace {

struct Corners {
  const std::int32_t* indices;
  int face_count, per_face;

  int count() const { return face_count * per_face; }
  int Next(int corner) const {
    return corner % per_face + 1 < per_face ? corner + 1 : First(corner);
  }
  int Previous(int corner) const {
    return corner % per_face > 0 ? corner - 1 : corner + per_face - 1;
  }
  int First(int corner) const { return corner - corner % per_face; }
  std::int32_t From(int half_edge) const { return indices[half_edge]; }
  std::int32_t To(int half_edge) const { return indices[Next(half_edge)]; }
};

std::string IndexProblem(const Corners& corners, std::size_t vertex_count) {
  std::vector<bool> used(vertex_count, false);
  for (int c = 0; c < corners.count(); ++c) {
    const std::int32_t v = corners.From(c);
    const int face = c / corners.per_face;
    if (v < 0 || static_cast<std::size_t>(v) >= vertex_count) {
      return fmt::format("face {} refers to vertex {}, but there are {} vertices", face, v,
                         vertex_count);
    }
    for (int other = corners.First(c); other < c; ++other) {
      if (corners.From(other) == v) return fmt::format("face {} uses vertex {} twice", face, v);
    }
    used[v] = true;
  }
  const auto unused = std::find(used.begin(), used.end(), false);
  if (unused != used.end()) {
    return fmt::format("vertex {} belongs to no face", unused - used.begin());
  }
  return "";
}

// Half-edges sorted so that those of one edge stand together.
std::vector<int> SortedByEdge(const Corners& corners) {
  std::vector<std::pair<std::uint64_t, int>> keyed(corners.count());
  for (int h = 0; h < corners.count(); ++h) {
    const auto [low, high] = std::minmax({corners.From(h), corners.To(h)});
    keyed[h] = {static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high), h};
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<int> sorted(keyed.size());
  for (std::size_t i = 0; i < keyed.size(); ++i) sorted[i] = keyed[i].second;
  return sorted;
}

void SetProblem(HalfEdges& result, std::string problem) {
  if (result.problem.empty()) result.problem = std::move(problem);
}

// The half-edges of one edge: two of opposite direction, or a problem.
void JoinTwins(const Corners& corners, const int* group, std::size_t size, HalfEdges& result) {
  const int first = group[0];
  const std::int32_t a = corners.From(first), b = corners.To(first);
  if (size == 1) {
    result.closed = false;
    SetProblem(result, fmt::format("open edge: vertices {} and {} belong to one face only", a, b));
  } else if (size > 2) {
    SetProblem(result, fmt::format("edge of vertices {} and {} belongs to {} faces", a, b, size));
  } else if (corners.From(group[1]) == a) {
    SetProblem(result, fmt::format("the two faces at the edge of vertices {} and {} are oriented "
                                   "against each other",
                                   a, b));
  } else {
    result.twin[first] = group[1];
    result.twin[group[1]] = first;
  }
}

// Faces round each vertex must form a single fan.
std::string FanProblem(const Corners& corners, const HalfEdges& half_edges,
                       std::size_t vertex_count) {
  std::vector<int> face_count(vertex_count, 0), start(vertex_count, -1);
  for (int c = 0; c < corners.count(); ++c) {
    ++face_count[corners.From(c)];
    start[corners.From(c)] = c;
  }
  for (std::size_t v = 0; v < vertex_count; ++v) {
    int h = start[v], fan = 0;
    do {
      h = half_edges.twin[corners.Previous(h)];
      ++fan;
    } while (h != start[v]);
    if (fan != face_count[v]) {
      return fmt::format("vertex {} joins two surfaces that only touch there", v);
    }
  }
  return "";
}

}  // namespace

HalfEdges FindHalfEdges(const std::int32_t* indices, std::size_t face_count, int corners_per_face,
                        std::size_t vertex_count) {
  const Corners corners{indices, static_cast<int>(face_count), corners_per_face};
  HalfEdges result;
  result.twin.assign(corners.count(), -1);
  result.edge.assign(corners.count(), -1);
  result.closed = face_count > 0;
  result.problem = face_count == 0 ? "there are no faces" : IndexProblem(corners, vertex_count);

  const std::vector<int> sorted = SortedByEdge(corners);
  std::vector<int> leader(corners.count());  // the first half-edge of the same edge
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    const auto same_edge = [&](int h) {
      return std::minmax({corners.From(h), corners.To(h)}) ==
             std::minmax({corners.From(sorted[begin]), corners.To(sorted[begin])});
    };
    for (end = begin; end < sorted.size() && same_edge(sorted[end]); ++end) {
      leader[sorted[end]] = sorted[begin];
    }
    JoinTwins(corners, &sorted[begin], end - begin, result);
  }
  for (int h = 0; h < corners.count(); ++h) {
    result.edge[h] = leader[h] == h ? result.edge_count++ : result.edge[leader[h]];
  }
  if (result.problem.empty()) result.problem = FanProblem(corners, result, vertex_count);
  return result;
}

}  // namespace vitruvia
