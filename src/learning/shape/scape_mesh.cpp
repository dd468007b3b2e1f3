#include "learning/shape/scape_mesh.h"

#include <cmath>

#include <Eigen/SparseCholesky>

#include "core/error.h"

namespace vitruvia {
namespace {

// Edges and scaled normal of a triangle, as columns.
Matrix3<double> Frame(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  Matrix3<double> frame;
  frame.col(0) = b - a;
  frame.col(1) = c - a;
  const Vector3d normal = frame.col(0).cross(frame.col(1));
  frame.col(2) = normal / std::sqrt(normal.norm());
  return frame;
}

}  // namespace

struct ScapeMesh::Factorization {
  std::vector<Triangle> triangles;
  std::vector<std::array<Vector3d, 2>> edges;  // of the template
  std::vector<Matrix3<double>> inverse_frames;
  std::size_t vertex_count = 0;
  Vector3d mean = Vector3d::Zero();  // of the template's vertices
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
};

ScapeMesh::ScapeMesh(const TriangleMesh& rest) : factorization_(std::make_unique<Factorization>()) {
  Factorization& f = *factorization_;
  if (const MeshReport report = InspectMesh(rest); report.components != 1) {
    throw DataError(fmt::format("SCAPE mesh: {} pieces, expected one: nothing holds them together",
                                report.components));
  }
  f.triangles = rest.triangles;
  f.vertex_count = rest.vertices.size();
  for (const Vector3f& v : rest.vertices) f.mean += v.cast<double>();
  f.mean /= static_cast<double>(f.vertex_count);
  std::vector<Eigen::Triplet<double>> entries;
  for (const Triangle& t : f.triangles) {
    const Vector3d a = rest.vertices[t[0]].cast<double>(), b = rest.vertices[t[1]].cast<double>(),
                   c = rest.vertices[t[2]].cast<double>();
    f.edges.push_back({b - a, c - a});
    f.inverse_frames.push_back(Frame(a, b, c).inverse());
    if (!f.inverse_frames.back().allFinite()) {
      throw DataError(fmt::format("SCAPE mesh: the triangle of vertices {}, {}, {} is degenerate",
                                  t[0], t[1], t[2]));
    }
    for (const int end : {t[1], t[2]}) {
      entries.insert(entries.end(),
                     {{t[0], t[0], 1.0}, {end, end, 1.0}, {t[0], end, -1.0}, {end, t[0], -1.0}});
    }
  }
  // Edges do not determine the surface's position: one vertex is fixed, and the mean is moved
  // afterwards.
  entries.emplace_back(0, 0, 1.0);
  const auto n = static_cast<Eigen::Index>(f.vertex_count);
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  f.solver.compute(matrix);
  if (f.solver.info() != Eigen::Success) {
    throw DataError("SCAPE mesh: the system of its edges is singular");
  }
}

ScapeMesh::~ScapeMesh() = default;

std::size_t ScapeMesh::triangle_count() const { return factorization_->triangles.size(); }

Eigen::MatrixXd ScapeMesh::Integrate(const Eigen::Ref<const Eigen::MatrixXf>& deformations) const {
  const Factorization& f = *factorization_;
  Require(deformations.rows() == static_cast<Eigen::Index>(9 * f.triangles.size()),
          "ScapeMesh::Integrate: {} rows, expected 9 × {} triangles", deformations.rows(),
          f.triangles.size());
  const auto n = static_cast<Eigen::Index>(f.vertex_count);
  Eigen::MatrixXd vertices(3 * n, deformations.cols());
  Eigen::MatrixX3d right_side(n, 3);
  for (Eigen::Index column = 0; column < deformations.cols(); ++column) {
    right_side.setZero();
    for (std::size_t k = 0; k < f.triangles.size(); ++k) {
      const Matrix3<double> deformation =
          Eigen::Map<const Matrix3<float>>(deformations.col(column).data() + 9 * k).cast<double>();
      for (int e = 0; e < 2; ++e) {
        const Eigen::RowVector3d edge = (deformation * f.edges[k][e]).transpose();
        right_side.row(f.triangles[k][e + 1]) += edge;
        right_side.row(f.triangles[k][0]) -= edge;
      }
    }
    Eigen::MatrixX3d solution = f.solver.solve(right_side);
    solution.rowwise() -= solution.colwise().mean().eval();
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>(
        vertices.col(column).data(), n, 3) = solution;
  }
  return vertices;
}

std::vector<Vector3d> ScapeMesh::Solve(const std::vector<Matrix3<double>>& pose,
                                       const std::vector<Matrix3<double>>& shape) const {
  const std::size_t count = triangle_count();
  Require(pose.size() == count && shape.size() == count,
          "ScapeMesh::Solve: {} poses and {} shapes, expected one of each for {} triangles",
          pose.size(), shape.size(), count);
  Eigen::MatrixXf deformations(static_cast<Eigen::Index>(9 * count), 1);
  for (std::size_t k = 0; k < count; ++k) {
    Eigen::Map<Matrix3<float>>(&deformations(static_cast<Eigen::Index>(9 * k), 0)) =
        (pose[k] * shape[k]).cast<float>();
  }
  const Eigen::MatrixXd flat = Integrate(deformations);
  std::vector<Vector3d> vertices(factorization_->vertex_count);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    vertices[v] = flat.block<3, 1>(static_cast<Eigen::Index>(3 * v), 0) + factorization_->mean;
  }
  return vertices;
}

Eigen::VectorXf ScapeMesh::Deformations(const std::vector<Vector3f>& vertices) const {
  const Factorization& f = *factorization_;
  Require(vertices.size() == f.vertex_count,
          "ScapeMesh::Deformations: {} vertices, the template has {}", vertices.size(),
          f.vertex_count);
  Eigen::VectorXf deformations(static_cast<Eigen::Index>(9 * f.triangles.size()));
  for (std::size_t k = 0; k < f.triangles.size(); ++k) {
    const Triangle& t = f.triangles[k];
    const Matrix3<double> deformation =
        Frame(vertices[t[0]].cast<double>(), vertices[t[1]].cast<double>(),
              vertices[t[2]].cast<double>()) *
        f.inverse_frames[k];
    Eigen::Map<Matrix3<float>>(&deformations(static_cast<Eigen::Index>(9 * k))) =
        deformation.cast<float>();
  }
  return deformations;
}

}  // namespace vitruvia
