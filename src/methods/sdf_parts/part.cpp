#include "methods/sdf_parts/part.h"

#include <map>
#include <utility>

#include "core/disjoint_sets.h"
#include "core/error.h"

namespace vitruvia::sdf_parts {
namespace {

float WeightOf(const SkinWeights& weights, std::int32_t vertex, int bone) {
  for (int k = 0; k < kMaxInfluences; ++k) {
    if (weights.bones[vertex][k] == bone && weights.weights[vertex][k] > 0.0f) {
      return weights.weights[vertex][k];
    }
  }
  return 0.0f;
}

std::vector<Triangle> TrianglesOf(const BodyModel& body, int bone, double least_weight) {
  std::vector<Triangle> triangles;
  for (const Triangle& t : body.rest.triangles) {
    float sum = 0.0f;
    for (const std::int32_t corner : t) sum += WeightOf(body.weights, corner, bone);
    if (sum >= 3.0 * least_weight) triangles.push_back(t);
  }
  return triangles;
}

// The vertices that the triangles use, in ascending order of their old numbers.
TriangleMesh Compacted(const std::vector<Vector3f>& vertices, std::vector<Triangle> triangles) {
  std::map<std::int32_t, std::int32_t> renamed;
  for (const Triangle& t : triangles) {
    for (const std::int32_t corner : t) renamed.emplace(corner, 0);
  }
  TriangleMesh mesh;
  for (auto& [old_index, new_index] : renamed) {
    new_index = static_cast<std::int32_t>(mesh.vertices.size());
    mesh.vertices.push_back(vertices[old_index]);
  }
  for (Triangle& t : triangles) {
    for (std::int32_t& corner : t) corner = renamed.at(corner);
  }
  mesh.triangles = std::move(triangles);
  return mesh;
}

using Edge = std::pair<std::int32_t, std::int32_t>;

// Edges of one triangle only, in its direction.
std::vector<Edge> OpenEdges(const TriangleMesh& mesh) {
  std::map<Edge, int> count;
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const std::int32_t from = t[k], to = t[(k + 1) % 3];
      const auto opposite = count.find({to, from});
      if (opposite != count.end()) {
        count.erase(opposite);
      } else {
        ++count[{from, to}];
      }
    }
  }
  std::vector<Edge> edges;
  for (const auto& [edge, times] : count) edges.push_back(edge);
  return edges;
}

// Each set of open edges that hang together gets a fan about its middle. Every vertex has as many
// open edges that begin as that end there, so the result is closed whatever the edges' shape.
void Close(TriangleMesh& mesh) {
  const std::vector<Edge> edges = OpenEdges(mesh);
  const std::size_t count = mesh.vertices.size();
  DisjointSets sets(count);
  for (const auto& [from, to] : edges) sets.Join(from, to);
  struct Middle {
    Vector3f sum = Vector3f::Zero();
    float edges = 0.0f;
    std::int32_t vertex = -1;
  };
  std::map<int, Middle> middles;
  for (const auto& [from, to] : edges) {
    Middle& middle = middles[sets.Find(from)];
    middle.sum += 0.5f * (mesh.vertices[from] + mesh.vertices[to]);
    middle.edges += 1.0f;
  }
  for (auto& [set, middle] : middles) {
    middle.vertex = static_cast<std::int32_t>(mesh.vertices.size());
    mesh.vertices.push_back(middle.sum / middle.edges);
  }
  for (const auto& [from, to] : edges) {
    mesh.triangles.push_back({to, from, middles.at(sets.Find(from)).vertex});
  }
}

}  // namespace

std::vector<Part> CutIntoParts(const BodyModel& body, double least_weight) {
  std::vector<Part> parts;
  for (int bone = 0; bone < kBoneCount; ++bone) {
    std::vector<Triangle> triangles = TrianglesOf(body, bone, least_weight);
    if (triangles.empty()) {
      throw DataError(fmt::format("{}: no triangle follows bone {} by {:g} or more", body.name,
                                  Bones()[bone].name, least_weight));
    }
    Part part{bone, Compacted(body.rest.vertices, std::move(triangles))};
    Close(part.mesh);
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace vitruvia::sdf_parts
