#include <algorithm>
#include <map>
#include <numeric>

#include "core/disjoint_sets.h"
#include "core/error.h"
#include "learning/scan/scan_surface.h"

namespace vitruvia {
namespace {

// Each short edge becomes a point, the lower of its two vertices.
void ContractShortEdges(TriangleMesh& mesh, double short_edge_m) {
  DisjointSets sets(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = t[k], b = t[(k + 1) % 3];
      if ((mesh.vertices[a] - mesh.vertices[b]).norm() < short_edge_m) sets.Join(a, b);
    }
  }
  std::vector<Triangle> kept;
  for (Triangle t : mesh.triangles) {
    for (std::int32_t& v : t) v = sets.Find(v);
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    if (TriangleArea(mesh, t) > 0.0) kept.push_back(t);
  }
  mesh.triangles = std::move(kept);
}

// The components, largest first, and for each triangle its component.
std::vector<SurfaceComponent> FindComponents(const TriangleMesh& mesh, std::vector<int>& owner) {
  DisjointSets sets(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    sets.Join(t[0], t[1]);
    sets.Join(t[1], t[2]);
  }
  std::map<std::int32_t, int> number_of;  // of each set
  std::vector<SurfaceComponent> found;
  owner.clear();
  for (const Triangle& t : mesh.triangles) {
    const auto [entry, is_new] =
        number_of.try_emplace(sets.Find(t[0]), static_cast<int>(found.size()));
    if (is_new) found.emplace_back();
    SurfaceComponent& component = found[static_cast<std::size_t>(entry->second)];
    component.area_m2 += TriangleArea(mesh, t);
    ++component.triangles;
    for (const std::int32_t v : t) component.box.extend(mesh.vertices[v]);
    owner.push_back(entry->second);
  }
  std::vector<int> order(found.size()), rank(found.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return found[a].area_m2 > found[b].area_m2; });
  std::vector<SurfaceComponent> sorted;
  for (const int component : order) {
    rank[component] = static_cast<int>(sorted.size());
    sorted.push_back(found[component]);
  }
  for (int& component : owner) component = rank[component];
  return sorted;
}

// Leaves out vertices that no triangle uses.
void DropUnusedVertices(TriangleMesh& mesh, std::vector<float>& weights) {
  std::vector<std::int32_t> renumbered(mesh.vertices.size(), -1);
  for (const Triangle& t : mesh.triangles) {
    for (const std::int32_t v : t) renumbered[v] = 0;
  }
  std::int32_t count = 0;
  for (std::size_t v = 0; v < renumbered.size(); ++v) {
    if (renumbered[v] < 0) continue;
    mesh.vertices[count] = mesh.vertices[v];
    weights[count] = weights[v];
    renumbered[v] = count++;
  }
  mesh.vertices.resize(count);
  weights.resize(count);
  for (Triangle& t : mesh.triangles) {
    for (std::int32_t& v : t) v = renumbered[v];
  }
}

}  // namespace

std::vector<BoundaryLoop> FindBoundaryLoops(const TriangleMesh& mesh) {
  // Directed edges without their opposite: each continues where the next begins.
  std::map<std::pair<std::int32_t, std::int32_t>, int> uses;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++uses[{t[k], t[(k + 1) % 3]}];
  }
  std::multimap<std::int32_t, std::int32_t> next;
  for (const auto& [edge, count] : uses) {
    if (!uses.contains({edge.second, edge.first})) next.emplace(edge.first, edge.second);
  }
  std::vector<BoundaryLoop> loops;
  while (!next.empty()) {
    BoundaryLoop loop;
    Vector3d center = Vector3d::Zero(), twice_area = Vector3d::Zero();
    const Vector3d origin = mesh.vertices[next.begin()->first].cast<double>();
    for (auto edge = next.begin(); edge != next.end();) {
      const Vector3d from = mesh.vertices[edge->first].cast<double>();
      const std::int32_t arrived = edge->second;
      const Vector3d to = mesh.vertices[arrived].cast<double>();
      loop.perimeter_m += (to - from).norm();
      center += (to - from).norm() * 0.5 * (from + to);
      twice_area += (from - origin).cross(to - origin);
      ++loop.edges;
      next.erase(edge);
      edge = next.find(arrived);
    }
    loop.area_m2 = 0.5 * twice_area.norm();
    if (loop.perimeter_m > 0.0) loop.center = (center / loop.perimeter_m).cast<float>();
    loops.push_back(loop);
  }
  std::stable_sort(loops.begin(), loops.end(), [](const BoundaryLoop& a, const BoundaryLoop& b) {
    return a.perimeter_m > b.perimeter_m;
  });
  return loops;
}

ScanSurface Cleaned(RawSurface raw, double short_edge_m, double island_share) {
  Require(raw.weights.size() == raw.mesh.vertices.size(), "Cleaned: {} weights for {} vertices",
          raw.weights.size(), raw.mesh.vertices.size());
  ScanSurface surface;
  surface.mesh = std::move(raw.mesh);
  surface.weights = std::move(raw.weights);
  ContractShortEdges(surface.mesh, short_edge_m);
  std::vector<int> owner;
  surface.components = FindComponents(surface.mesh, owner);
  for (SurfaceComponent& component : surface.components) {
    component.kept = component.area_m2 >= island_share * surface.components.front().area_m2;
  }
  std::vector<Triangle> kept;
  for (std::size_t t = 0; t < owner.size(); ++t) {
    if (surface.components[owner[t]].kept) kept.push_back(surface.mesh.triangles[t]);
  }
  surface.mesh.triangles = std::move(kept);
  DropUnusedVertices(surface.mesh, surface.weights);
  ComputeVertexNormals(surface.mesh.vertices, surface.mesh.triangles, surface.normals);
  surface.holes = FindBoundaryLoops(surface.mesh);
  return surface;
}

}  // namespace vitruvia
