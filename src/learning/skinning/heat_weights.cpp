#include "learning/skinning/heat_weights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/SparseCholesky>

#include "core/error.h"
#include "math/angles.h"

namespace vitruvia::skinning {
namespace {

constexpr double kTie_m = 1e-5;      // distances that differ by less are equal
constexpr double kNearest_m = 1e-3;  // a vertex on a bone is heated as one this far from it
constexpr double kSingular = 1e-13;  // of the largest pivot

Vector3d ClosestOnSegment(const Vector3d& a, const Vector3d& b, const Vector3d& point) {
  const Vector3d along = b - a;
  const double length_squared = along.squaredNorm();
  if (length_squared == 0.0) return a;
  return a + std::clamp((point - a).dot(along) / length_squared, 0.0, 1.0) * along;
}

// Triangles by the cells of a grid that their boxes overlap, to ask what a segment crosses.
class TriangleGrid {
 public:
  explicit TriangleGrid(const TriangleMesh& mesh) : mesh_(mesh), box_(BoundingBox(mesh.vertices)) {
    const Vector3f size = box_.sizes();
    for (int k = 0; k < 3; ++k) count_[k] = std::max(1, static_cast<int>(size[k] / kCell_m) + 1);
    cells_.resize(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2]);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      Eigen::AlignedBox3f box;
      for (const int v : mesh.triangles[t]) box.extend(mesh.vertices[v]);
      ForCells(box, [&](std::size_t cell) {
        cells_[cell].push_back(static_cast<int>(t));
        return false;
      });
    }
  }

  // Whether the segment from that vertex to `end` passes through a triangle that the vertex is no
  // corner of.
  bool Crosses(int vertex, const Vector3d& end) const {
    const Vector3d start = mesh_.vertices[vertex].cast<double>();
    Eigen::AlignedBox3f box(mesh_.vertices[vertex]);
    box.extend(end.cast<float>().eval());
    return ForCells(box, [&](std::size_t cell) {
      return std::any_of(cells_[cell].begin(), cells_[cell].end(), [&](int t) {
        const Triangle& triangle = mesh_.triangles[t];
        return std::find(triangle.begin(), triangle.end(), vertex) == triangle.end() &&
               IsCrossed(triangle, start, end - start);
      });
    });
  }

 private:
  static constexpr float kCell_m = 0.04f;

  // Calls visit for the cells that a box overlaps until it returns true.
  template <class Visit>
  bool ForCells(const Eigen::AlignedBox3f& box, const Visit& visit) const {
    std::array<int, 3> first{}, last{};
    for (int k = 0; k < 3; ++k) {
      const auto cell = [&](float x) {
        return std::clamp(static_cast<int>((x - box_.min()[k]) / kCell_m), 0, count_[k] - 1);
      };
      first[k] = cell(box.min()[k]);
      last[k] = cell(box.max()[k]);
    }
    for (int z = first[2]; z <= last[2]; ++z) {
      for (int y = first[1]; y <= last[1]; ++y) {
        for (int x = first[0]; x <= last[0]; ++x) {
          if (visit((static_cast<std::size_t>(z) * count_[1] + y) * count_[0] + x)) return true;
        }
      }
    }
    return false;
  }

  // Möller & Trumbore 1997, for the open segment start + s · along, 0 < s < 1.
  bool IsCrossed(const Triangle& triangle, const Vector3d& start, const Vector3d& along) const {
    const Vector3d a = mesh_.vertices[triangle[0]].cast<double>();
    const Vector3d ab = mesh_.vertices[triangle[1]].cast<double>() - a;
    const Vector3d ac = mesh_.vertices[triangle[2]].cast<double>() - a;
    const Vector3d p = along.cross(ac);
    const double determinant = ab.dot(p);
    if (determinant == 0.0) return false;
    const Vector3d from_a = start - a;
    const double u = from_a.dot(p) / determinant;
    if (u < 0.0 || u > 1.0) return false;
    const Vector3d q = from_a.cross(ab);
    const double v = along.dot(q) / determinant;
    if (v < 0.0 || u + v > 1.0) return false;
    const double s = ac.dot(q) / determinant;
    return s > 0.0 && s < 1.0;
  }

  const TriangleMesh& mesh_;
  Eigen::AlignedBox3f box_;
  std::array<int, 3> count_{};
  std::vector<std::vector<int>> cells_;
};

// Adds the cotangent Laplacian's entries, and a third of each triangle's area to its corners.
void AddTriangle(const TriangleMesh& mesh, const Triangle& triangle,
                 std::vector<Eigen::Triplet<double>>& entries, Eigen::VectorXd& areas) {
  for (int k = 0; k < 3; ++k) {
    const int at = triangle[k], i = triangle[(k + 1) % 3], j = triangle[(k + 2) % 3];
    const Vector3d to_i = (mesh.vertices[i] - mesh.vertices[at]).cast<double>();
    const Vector3d to_j = (mesh.vertices[j] - mesh.vertices[at]).cast<double>();
    const double twice_area = to_i.cross(to_j).norm();
    const double half_cotangent = 0.5 * to_i.dot(to_j) / twice_area;
    entries.insert(entries.end(), {{i, i, half_cotangent},
                                   {j, j, half_cotangent},
                                   {i, j, -half_cotangent},
                                   {j, i, -half_cotangent}});
    areas[at] += twice_area / 6.0;
  }
}

}  // namespace

void HeatWeightSettings::Describe(Fields& f) {
  f.Number(
      "heat", heat,
      {.meaning =
           "heat transfer from the nearest bone to a vertex, as a factor on 1 / squared distance",
       .min = 1e-3,
       .max = 1e3,
       .origin = Origin::kPaper,
       .source = "Baran & Popović 2007, sec. 4: c = 1; their scale of areas is not printed"});
  f.Number("visible_angle_deg", visible_angle_deg,
           {.meaning = "a vertex sees a bone only within this angle of its inward normal",
            .unit = "deg",
            .min = 1.0,
            .max = 180.0,
            .origin = Origin::kPaper,
            .source = "Baran & Popović's program"});
}

std::vector<BoneContact> NearestVisibleBones(const TriangleMesh& rest, const Skeleton& skeleton,
                                             double visible_angle_deg) {
  std::vector<Vector3f> normals;
  ComputeVertexNormals(rest.vertices, rest.triangles, normals);
  const TriangleGrid grid(rest);
  const double least_cosine = std::cos(visible_angle_deg * kRadiansPerDegree);
  std::vector<BoneContact> contacts(rest.vertices.size());
  for (std::size_t v = 0; v < rest.vertices.size(); ++v) {
    const Vector3d vertex = rest.vertices[v].cast<double>();
    std::array<Vector3d, kBoneCount> closest;
    double nearest_m = std::numeric_limits<double>::infinity();
    for (int b = 0; b < kBoneCount; ++b) {
      closest[b] = ClosestOnSegment(skeleton.joints[b], skeleton.tips[b], vertex);
      nearest_m = std::min(nearest_m, (closest[b] - vertex).norm());
    }
    contacts[v].distance_m = nearest_m;
    const Vector3d inward = -normals[v].cast<double>();
    for (int b = 0; b < kBoneCount; ++b) {
      const Vector3d to_bone = closest[b] - vertex;
      if (to_bone.norm() > nearest_m + kTie_m) continue;
      if (to_bone.dot(inward) < least_cosine * to_bone.norm()) continue;
      if (grid.Crosses(static_cast<int>(v), closest[b])) continue;
      contacts[v].bones.push_back(static_cast<std::uint8_t>(b));
    }
  }
  return contacts;
}

Eigen::MatrixXd HeatDistribution(const TriangleMesh& rest, const std::vector<BoneContact>& contacts,
                                 double heat) {
  const auto n = static_cast<Eigen::Index>(rest.vertices.size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(n);
  for (const Triangle& triangle : rest.triangles) AddTriangle(rest, triangle, entries, areas);
  Eigen::MatrixXd right_side = Eigen::MatrixXd::Zero(n, kBoneCount);
  for (Eigen::Index v = 0; v < n; ++v) {
    const BoneContact& contact = contacts[static_cast<std::size_t>(v)];
    if (contact.bones.empty()) continue;
    const double distance_m = std::max(kNearest_m, contact.distance_m);
    const double heating = areas[v] * heat / (distance_m * distance_m);
    entries.emplace_back(v, v, heating);
    for (const int b : contact.bones) {
      right_side(v, b) += heating / static_cast<double>(contact.bones.size());
    }
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> cholesky(matrix);
  if (cholesky.info() != Eigen::Success ||
      !(cholesky.vectorD().minCoeff() > kSingular * cholesky.vectorD().maxCoeff())) {
    throw DataError(
        "heat weights: the system is singular; expected a mesh without degenerate triangles, each "
        "piece of which holds a part of the skeleton");
  }
  return cholesky.solve(right_side);
}

SkinWeights HeatWeights(const TriangleMesh& rest, const Skeleton& skeleton,
                        const HeatWeightSettings& settings) {
  const Eigen::MatrixXd weights =
      HeatDistribution(rest, NearestVisibleBones(rest, skeleton, settings.visible_angle_deg),
                       settings.heat)
          .cwiseMax(0.0)
          .cwiseMin(1.0);
  return Sparsified(weights.cast<float>());
}

}  // namespace vitruvia::skinning
