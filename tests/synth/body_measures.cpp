#include "body_measures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace vitruvia {
namespace {

using Vector2d = Eigen::Vector2d;

// Andrew's monotone chain.
double HullLength(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  const auto chain_length = [](const auto& ordered) {
    std::vector<Vector2d> chain;
    for (const Vector2d& p : ordered) {
      while (chain.size() >= 2) {
        const Vector2d u = chain.back() - chain[chain.size() - 2], w = p - chain.back();
        if (u.x() * w.y() - u.y() * w.x() > 0.0) break;
        chain.pop_back();
      }
      chain.push_back(p);
    }
    double length = 0.0;
    for (std::size_t i = 1; i < chain.size(); ++i) length += (chain[i] - chain[i - 1]).norm();
    return length;
  };
  const double lower = chain_length(points);
  std::reverse(points.begin(), points.end());
  return lower + chain_length(points);
}

struct Corners {
  Vector3d a, b, c;
};
Corners CornersOf(const TriangleMesh& mesh, const Triangle& t) {
  return {mesh.vertices[t[0]].cast<double>(), mesh.vertices[t[1]].cast<double>(),
          mesh.vertices[t[2]].cast<double>()};
}

bool Pierces(const Vector3d& p, const Vector3d& q, const Corners& t) {
  const Vector3d normal = (t.b - t.a).cross(t.c - t.a);
  const double p_side = normal.dot(p - t.a), q_side = normal.dot(q - t.a);
  if ((p_side > 0.0) == (q_side > 0.0)) return false;
  const Vector3d x = p + (q - p) * (p_side / (p_side - q_side));
  return normal.dot((t.b - t.a).cross(x - t.a)) > 0.0 &&
         normal.dot((t.c - t.b).cross(x - t.b)) > 0.0 &&
         normal.dot((t.a - t.c).cross(x - t.c)) > 0.0;
}

bool Cross(const Corners& s, const Corners& t) {
  return Pierces(s.a, s.b, t) || Pierces(s.b, s.c, t) || Pierces(s.c, s.a, t) ||
         Pierces(t.a, t.b, s) || Pierces(t.b, t.c, s) || Pierces(t.c, t.a, s);
}

}  // namespace

double TapeGirth(const TriangleMesh& mesh, const Vector3d& point_on_plane, const Vector3d& normal,
                 const std::function<bool(const Vector3d&)>& keep) {
  const Vector3d unit = normal.normalized(), u = unit.unitOrthogonal(), w = unit.cross(u);
  std::vector<Vector2d> cut;
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Vector3d a = mesh.vertices[t[k]].cast<double>();
      const Vector3d b = mesh.vertices[t[(k + 1) % 3]].cast<double>();
      const double a_side = (a - point_on_plane).dot(unit), b_side = (b - point_on_plane).dot(unit);
      if ((a_side < 0.0) == (b_side < 0.0)) continue;
      const Vector3d p = a + (b - a) * (a_side / (a_side - b_side));
      if (keep(p)) cut.emplace_back(p.dot(u), p.dot(w));
    }
  }
  return HullLength(std::move(cut));
}

double WindingNumber(const TriangleMesh& mesh, const Vector3d& point) {
  double solid_angle = 0.0;
  for (const Triangle& t : mesh.triangles) {
    auto [a, b, c] = CornersOf(mesh, t);
    a -= point, b -= point, c -= point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    solid_angle += 2.0 * std::atan2(a.dot(b.cross(c)),
                                    la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return solid_angle / (4.0 * std::numbers::pi);
}

int CountSelfIntersections(const TriangleMesh& mesh) {
  struct Entry {
    Vector3d low, high;
    Corners corners;
    Triangle triangle;
  };
  std::vector<Entry> entries;
  entries.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    const Corners k = CornersOf(mesh, t);
    entries.push_back({k.a.cwiseMin(k.b).cwiseMin(k.c), k.a.cwiseMax(k.b).cwiseMax(k.c), k, t});
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& s, const Entry& t) { return s.low.y() < t.low.y(); });
  int count = 0;
  for (auto s = entries.begin(); s != entries.end(); ++s) {
    for (auto t = s + 1; t != entries.end() && t->low.y() <= s->high.y(); ++t) {
      if ((s->low.array() > t->high.array()).any() || (t->low.array() > s->high.array()).any()) {
        continue;
      }
      const bool neighbours =
          std::any_of(s->triangle.begin(), s->triangle.end(), [&](std::int32_t v) {
            return std::find(t->triangle.begin(), t->triangle.end(), v) != t->triangle.end();
          });
      if (!neighbours && Cross(s->corners, t->corners)) ++count;
    }
  }
  return count;
}

}  // namespace vitruvia
