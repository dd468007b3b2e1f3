#include "methods/dynamic/tracked_mesh.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/disjoint_sets.h"
#include "methods/dynamic/surface.h"

namespace vitruvia::dynamic {
namespace {

SkinWeights OnlyLargest(const SkinWeights& weights) {
  SkinWeights result = weights;
  for (auto& w : result.weights) w = {1.0f, 0.0f, 0.0f, 0.0f};
  return result;
}

// Adds a vertex that follows one bone alone.
int AddVertex(const Vector3f& position, std::uint8_t bone, TrackedMesh& mesh) {
  mesh.vertices.push_back(position);
  mesh.weights.bones.push_back({bone, 0, 0, 0});
  mesh.weights.weights.push_back({1.0f, 0.0f, 0.0f, 0.0f});
  return static_cast<int>(mesh.vertices.size()) - 1;
}

// Directed edges without an opposite one: the rims of the holes, as the triangles go along them.
std::vector<std::pair<int, int>> Rims(const std::vector<Triangle>& triangles) {
  std::set<std::pair<int, int>> edges;
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) edges.emplace(t[k], t[(k + 1) % 3]);
  }
  std::vector<std::pair<int, int>> rims;
  for (const auto& [from, to] : edges) {
    if (!edges.contains({to, from})) rims.emplace_back(from, to);
  }
  return rims;
}

// Connected components of the rims: for each vertex the lowest vertex of its rim.
std::vector<int> RimOf(const std::vector<std::pair<int, int>>& rims, std::size_t vertex_count) {
  DisjointSets sets(vertex_count);
  for (const auto& [from, to] : rims) sets.Join(from, to);
  std::vector<int> rim_of(vertex_count);
  for (std::size_t v = 0; v < vertex_count; ++v) rim_of[v] = sets.Find(static_cast<int>(v));
  return rim_of;
}

void CloseHoles(TrackedMesh& mesh) {
  const auto rims = Rims(mesh.triangles);
  const std::vector<int> rim_of = RimOf(rims, mesh.vertices.size());
  std::map<int, std::pair<Vector3f, int>> sums;
  for (const auto& [from, to] : rims) {
    auto& [sum, count] = sums.try_emplace(rim_of[from], Vector3f::Zero(), 0).first->second;
    sum += mesh.vertices[from];
    ++count;
  }
  std::map<int, int> middles;
  for (const auto& [rim, sum] : sums) {
    middles[rim] =
        AddVertex(sum.first / static_cast<float>(sum.second), mesh.weights.bones[rim][0], mesh);
  }
  for (const auto& [from, to] : rims) {
    mesh.triangles.push_back({to, from, middles.at(rim_of[from])});
  }
}

}  // namespace

TrackedMesh SmoothMesh(const BodyModel& subject) {
  TrackedMesh mesh{subject.rest.vertices, {}, subject.rest.triangles, subject.weights};
  ComputeVertexNormals(mesh.vertices, mesh.triangles, mesh.normals);
  return mesh;
}

TrackedMesh RigidSegments(const BodyModel& subject) {
  TrackedMesh mesh{subject.rest.vertices, {}, {}, OnlyLargest(subject.weights)};
  const auto bone = [&](int v) { return mesh.weights.bones[v][0]; };
  for (const Triangle& t : subject.rest.triangles) {
    if (bone(t[0]) == bone(t[1]) && bone(t[0]) == bone(t[2])) mesh.triangles.push_back(t);
  }
  CloseHoles(mesh);
  ComputeVertexNormals(mesh.vertices, mesh.triangles, mesh.normals);
  return mesh;
}

std::vector<int> SpreadVertices(const TrackedMesh& mesh, int stride) {
  const SurfaceLayout layout(mesh.weights);
  std::vector<int> kept;
  for (const Patch& patch : layout.patches) {
    for (int slot = patch.begin; slot < patch.end; slot += stride) {
      if (layout.vertex_of_slot[slot] >= 0) kept.push_back(layout.vertex_of_slot[slot]);
    }
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

TrackedMesh Subset(const TrackedMesh& mesh, const std::vector<int>& vertices) {
  TrackedMesh subset;
  for (const int v : vertices) {
    subset.vertices.push_back(mesh.vertices[v]);
    subset.normals.push_back(mesh.normals[v]);
    subset.weights.bones.push_back(mesh.weights.bones[v]);
    subset.weights.weights.push_back(mesh.weights.weights[v]);
  }
  return subset;
}

}  // namespace vitruvia::dynamic
