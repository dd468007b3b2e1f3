#include "geometry/surface_map.h"

#include <algorithm>
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

// Barycentric coordinates of the triangle's point closest to p, by the Voronoi regions of its
// corners and sides (Ericson 2005, sec. 5.1.5).
Vector3d ClosestBarycentric(const Vector3d& p, const Vector3d& a, const Vector3d& b,
                            const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return {1.0, 0.0, 0.0};
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return {0.0, 1.0, 0.0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double t = d1 / (d1 - d3);
    return {1.0 - t, t, 0.0};
  }
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return {0.0, 0.0, 1.0};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double t = d2 / (d2 - d6);
    return {1.0 - t, 0.0, t};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0.0, 1.0 - t, t};
  }
  return Vector3d(va, vb, vc) / (va + vb + vc);
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
      for (int i = node.begin; i < node.end; ++i) TryTriangle(order_[i], point, best);
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

  void TryTriangle(std::int32_t triangle, const Vector3d& point, Candidate& best) const {
    const Vector3d a = Corner(triangle, 0), b = Corner(triangle, 1), c = Corner(triangle, 2);
    Candidate candidate{0.0, triangle, ClosestBarycentric(point, a, b, c)};
    const Vector3d& w = candidate.barycentric;
    candidate.squared_distance = (w[0] * a + w[1] * b + w[2] * c - point).squaredNorm();
    if (candidate.Beats(best)) best = candidate;
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
