#include "geometry/surface_map.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "core/error.h"

// Precision: double throughout, rounded once at the end. In float, ties between triangles that
// share an edge would be decided by rounding.
namespace vitruvia {
namespace {

struct Candidate {
  double squared_distance = std::numeric_limits<double>::infinity();
  std::int32_t triangle = -1;
  Vector3d barycentric = Vector3d::UnitX();

  // Nearer wins; of equals the lower index, whatever the order of the search.
  bool Beats(const Candidate& other) const {
    return squared_distance < other.squared_distance ||
           (squared_distance == other.squared_distance && triangle < other.triangle);
  }
};

using TriangleCorners = std::array<Vector3d, 3>;

// Tries a point of the triangle, given by its barycentric coordinates.
void Try(const Vector3d& point, const TriangleCorners& corners, std::int32_t triangle,
         const Vector3d& barycentric, Candidate& best) {
  const Vector3d on_triangle =
      barycentric[0] * corners[0] + barycentric[1] * corners[1] + barycentric[2] * corners[2];
  const Candidate candidate{(on_triangle - point).squaredNorm(), triangle, barycentric};
  if (candidate.Beats(best)) best = candidate;
}

// The closest point is the foot of the perpendicular, or lies on a side. All are tried, so that a
// triangle without area, for which the first is undefined, is handled correctly.
void TryTriangle(const Vector3d& point, const TriangleCorners& corners, std::int32_t triangle,
                 Candidate& best) {
  const Vector3d ab = corners[1] - corners[0], ac = corners[2] - corners[0];
  const Vector3d ap = point - corners[0], normal = ab.cross(ac);
  const double area_squared = normal.squaredNorm();
  if (area_squared > 0.0) {
    const double v = ap.cross(ac).dot(normal) / area_squared;
    const double w = ab.cross(ap).dot(normal) / area_squared;
    if (v > 0.0 && w > 0.0 && v + w < 1.0) {
      Try(point, corners, triangle, {1.0 - v - w, v, w}, best);
    }
  }
  for (int from = 0; from < 3; ++from) {
    const int to = (from + 1) % 3;
    const Vector3d side = corners[to] - corners[from];
    const double length_squared = side.squaredNorm();
    const double along = (point - corners[from]).dot(side);
    Vector3d barycentric = Vector3d::Zero();
    barycentric[to] = length_squared > 0.0 ? std::clamp(along / length_squared, 0.0, 1.0) : 0.0;
    barycentric[from] = 1.0 - barycentric[to];
    Try(point, corners, triangle, barycentric, best);
  }
}

// A binary tree of axis-aligned boxes over the triangles.
class BoxTree {
 public:
  explicit BoxTree(const TriangleMesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    nodes_.reserve(2 * order_.size());
    Build(0, static_cast<int>(order_.size()));
  }

  Candidate Closest(const Vector3d& point) const {
    Candidate best;
    Search(0, point, best);
    return best;
  }

 private:
  static constexpr int kLeafSize = 4;
  struct Node {
    Vector3d low, high;
    int begin, end;             // its triangles: positions in order_
    int left = -1, right = -1;  // -1: a leaf

    double SquaredDistance(const Vector3d& p) const {
      return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
    }
  };

  Vector3d Corner(std::int32_t triangle, int corner) const {
    return mesh_.vertices[mesh_.triangles[triangle][corner]].cast<double>();
  }

  int Build(int begin, int end) {
    Node node{Vector3d::Constant(std::numeric_limits<double>::infinity()),
              Vector3d::Constant(-std::numeric_limits<double>::infinity()), begin, end};
    for (int i = begin; i < end; ++i) {
      for (int k = 0; k < 3; ++k) {
        node.low = node.low.cwiseMin(Corner(order_[i], k));
        node.high = node.high.cwiseMax(Corner(order_[i], k));
      }
    }
    const int index = static_cast<int>(nodes_.size());
    nodes_.push_back(node);
    if (end - begin <= kLeafSize) return index;
    int axis = 0;
    (node.high - node.low).maxCoeff(&axis);
    const auto position = [&](std::int32_t t) {
      return Corner(t, 0)[axis] + Corner(t, 1)[axis] + Corner(t, 2)[axis];
    };
    const int middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::int32_t s, std::int32_t t) { return position(s) < position(t); });
    const int left = Build(begin, middle), right = Build(middle, end);
    nodes_[index].left = left;
    nodes_[index].right = right;
    return index;
  }

  void Search(int index, const Vector3d& point, Candidate& best) const {
    const Node& node = nodes_[index];
    if (node.left < 0) {
      for (int i = node.begin; i < node.end; ++i) {
        const std::int32_t t = order_[i];
        TryTriangle(point, {Corner(t, 0), Corner(t, 1), Corner(t, 2)}, t, best);
      }
      return;
    }
    std::array<std::pair<double, int>, 2> children{
        {{nodes_[node.left].SquaredDistance(point), node.left},
         {nodes_[node.right].SquaredDistance(point), node.right}}};
    if (children[1].first < children[0].first) std::swap(children[0], children[1]);
    for (const auto& [squared_distance, child] : children) {
      if (squared_distance <= best.squared_distance) Search(child, point, best);
    }
  }

  const TriangleMesh& mesh_;
  std::vector<std::int32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace

std::vector<SurfacePoint> ClosestSurfacePoints(const std::vector<Vector3f>& points,
                                               const TriangleMesh& mesh) {
  Require(!mesh.triangles.empty(), "ClosestSurfacePoints: the mesh has no triangles");
  const BoxTree tree(mesh);
  std::vector<SurfacePoint> result;
  result.reserve(points.size());
  for (const Vector3f& point : points) {
    Require(point.allFinite(), "ClosestSurfacePoints: point {} is not finite", result.size());
    const Candidate closest = tree.Closest(point.cast<double>());
    const Vector3f w = closest.barycentric.cast<float>();
    result.push_back({closest.triangle, {w[0], w[1], w[2]}});
  }
  return result;
}

}  // namespace vitruvia
