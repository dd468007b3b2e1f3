#include "geometry/decimation.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModAspectRatioT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include "core/error.h"

namespace vitruvia {
namespace {

constexpr double kMaxNormalTurn_deg = 90.0;
constexpr float kMaxAspectRatio = 8.0f;  // longest side to height; body meshes have up to about 6

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

HalfEdgeMesh ToHalfEdges(const TriangleMesh& mesh) {
  const MeshReport report = InspectMesh(mesh);
  if (!report.problem.empty()) {
    throw DataError(fmt::format("mesh to be decimated: {}", report.problem));
  }
  HalfEdgeMesh result;
  for (const Vector3f& v : mesh.vertices) result.add_vertex({v.x(), v.y(), v.z()});
  for (const auto& [a, b, c] : mesh.triangles) {
    result.add_face(OpenMesh::VertexHandle(a), OpenMesh::VertexHandle(b),
                    OpenMesh::VertexHandle(c));
  }
  return result;
}

void Collapse(HalfEdgeMesh& mesh, int target_vertices) {
  OpenMesh::Decimater::DecimaterT<HalfEdgeMesh> decimater(mesh);
  OpenMesh::Decimater::ModQuadricT<HalfEdgeMesh>::Handle quadric;
  OpenMesh::Decimater::ModNormalFlippingT<HalfEdgeMesh>::Handle normal;
  OpenMesh::Decimater::ModAspectRatioT<HalfEdgeMesh>::Handle aspect;
  decimater.add(quadric);
  decimater.module(quadric).unset_max_err();
  decimater.add(normal);
  decimater.module(normal).set_max_normal_deviation(kMaxNormalTurn_deg);
  decimater.add(aspect);
  decimater.module(aspect).set_aspect_ratio(kMaxAspectRatio);
  decimater.initialize();
  decimater.decimate_to(static_cast<std::size_t>(target_vertices));
}

}  // namespace

Decimation Decimate(const TriangleMesh& mesh, int target_vertices) {
  Require(target_vertices >= 4, "Decimate: to {} vertices, expected at least 4", target_vertices);
  HalfEdgeMesh half_edges = ToHalfEdges(mesh);
  half_edges.request_vertex_status();
  half_edges.request_edge_status();
  half_edges.request_face_status();
  half_edges.request_face_normals();
  half_edges.update_face_normals();
  Collapse(half_edges, target_vertices);

  Decimation result;
  std::vector<std::int32_t> new_index(mesh.vertices.size(), -1);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (half_edges.status(OpenMesh::VertexHandle(static_cast<int>(v))).deleted()) continue;
    new_index[v] = static_cast<std::int32_t>(result.kept.size());
    result.kept.push_back(static_cast<int>(v));
  }
  for (const auto face : half_edges.faces()) {  // skips those that are gone
    Triangle triangle{};
    std::size_t corner = 0;
    for (const auto vertex : half_edges.fv_range(face)) {
      triangle[corner++] = new_index[static_cast<std::size_t>(vertex.idx())];
    }
    result.triangles.push_back(triangle);
  }
  return result;
}

}  // namespace vitruvia
