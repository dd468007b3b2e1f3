#include "methods/dynamic/rest_mesh.h"

#include <algorithm>

namespace vitruvia::dynamic {
namespace {

constexpr int kFacesPerRange = 4096;
constexpr int kNormalsPerRange = 2048;

// Vertices one edge away, sorted.
std::vector<std::vector<int>> Rings(std::size_t vertex_count,
                                    const std::vector<Triangle>& triangles) {
  std::vector<std::vector<int>> rings(vertex_count);
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) {
      rings[t[k]].push_back(t[(k + 1) % 3]);
      rings[t[k]].push_back(t[(k + 2) % 3]);
    }
  }
  for (std::vector<int>& ring : rings) {
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  }
  return rings;
}

}  // namespace

NeighborTable ClosestNeighbors(const std::vector<Vector3f>& vertices,
                               const std::vector<Triangle>& triangles) {
  const auto rings = Rings(vertices.size(), triangles);
  NeighborTable table(vertices.size());
  std::vector<int> candidates;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    candidates = rings[v];
    for (const int near : rings[v]) {
      candidates.insert(candidates.end(), rings[near].begin(), rings[near].end());
    }
    std::sort(candidates.begin(), candidates.end());
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
    std::erase(candidates, static_cast<int>(v));
    const auto squared = [&](int other) { return (vertices[other] - vertices[v]).squaredNorm(); };
    const auto kept = std::min<std::size_t>(kNeighbors, candidates.size());
    std::partial_sort(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(kept),
                      candidates.end(), [&](int a, int b) {
                        return squared(a) < squared(b) || (squared(a) == squared(b) && a < b);
                      });
    table[v].fill(-1);
    std::copy_n(candidates.begin(), kept, table[v].begin());
  }
  return table;
}

RestNormals::RestNormals(const SurfaceLayout& layout, const std::vector<Triangle>& triangles)
    : triangles_(triangles), area_normals_(triangles.size()) {
  first_face_.assign(layout.slot_count() + 1, 0);
  for (Triangle& t : triangles_) {
    for (std::int32_t& corner : t) {
      corner = layout.slot_of_vertex[corner];
      ++first_face_[corner + 1];
    }
  }
  for (int slot = 0; slot < layout.slot_count(); ++slot) first_face_[slot + 1] += first_face_[slot];
  faces_.resize(3 * triangles_.size());
  std::vector<int> next(first_face_.begin(), first_face_.end() - 1);
  for (std::size_t f = 0; f < triangles_.size(); ++f) {
    for (const std::int32_t corner : triangles_[f]) faces_[next[corner]++] = static_cast<int>(f);
  }
}

void RestNormals::Update(WorkerTeam& team, Surface<float>& surface) {
  team.For(static_cast<int>(triangles_.size()), kFacesPerRange, [&](int begin, int end) {
    for (int f = begin; f < end; ++f) {
      const Vector3f a = surface.rest.At(triangles_[f][0]);
      const Vector3f ab = surface.rest.At(triangles_[f][1]) - a;
      const Vector3f ac = surface.rest.At(triangles_[f][2]) - a;
      area_normals_[f].head<3>() = ab.cross(ac).array();
    }
  });
  team.For(surface.layout.slot_count(), kNormalsPerRange, [&](int begin, int end) {
    for (int slot = begin; slot < end; ++slot) {
      if (first_face_[slot] == first_face_[slot + 1]) continue;  // filled up: never looked at
      Eigen::Array<float, 4, 1> sum = Eigen::Array<float, 4, 1>::Zero();
      for (int i = first_face_[slot]; i < first_face_[slot + 1]; ++i) {
        sum += area_normals_[faces_[i]];
      }
      const Vector3f normal = sum.head<3>().matrix();
      const float length = normal.norm();
      // A vertex whose triangles have all collapsed keeps the normal that it had.
      if (length > 0.0f) surface.rest_normals.Set(slot, normal / length);
    }
  });
}

}  // namespace vitruvia::dynamic
