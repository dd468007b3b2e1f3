#include "methods/sdf_parts/distance_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vitruvia::sdf_parts {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();

float Mix(float a, float b, float share) { return a + share * (b - a); }

// Ericson, Real-Time Collision Detection, sec. 5.1.5.
Vector3f ClosestOnTriangle(const Vector3f& p, const Vector3f& a, const Vector3f& b,
                           const Vector3f& c) {
  const Vector3f ab = b - a, ac = c - a, ap = p - a;
  const float d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0f && d2 <= 0.0f) return a;
  const Vector3f bp = p - b;
  const float d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0f && d4 <= d3) return b;
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0f && d1 >= 0.0f && d3 <= 0.0f) return a + d1 / (d1 - d3) * ab;
  const Vector3f cp = p - c;
  const float d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0f && d5 <= d6) return c;
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0f && d2 >= 0.0f && d6 <= 0.0f) return a + d2 / (d2 - d6) * ac;
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0.0f && d4 - d3 >= 0.0f && d5 - d6 >= 0.0f) {
    return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  }
  const float sum = va + vb + vc;
  if (!(sum > 0.0f)) return a;
  return a + vb / sum * ab + vc / sum * ac;
}

}  // namespace

struct DistanceField::Builder {
  Builder(DistanceField& to_build, double cell_m)
      : field(to_build),
        cell(static_cast<float>(cell_m)),
        nearest(field.values_.size(), Vector3f::Constant(kInfinite)),
        winding(field.values_.size(), 0) {}

  Vector3f Node(int i, int j, int k) const {
    return field.origin_ +
           cell * Vector3f(static_cast<float>(i), static_cast<float>(j), static_cast<float>(k));
  }

  // Exact distances at the nodes near a triangle.
  void AddTriangle(const Vector3f& a, const Vector3f& b, const Vector3f& c) {
    constexpr float kBand_cells = 1.8f;
    const Vector3f low = (a.cwiseMin(b).cwiseMin(c) - field.origin_) / cell;
    const Vector3f high = (a.cwiseMax(b).cwiseMax(c) - field.origin_) / cell;
    std::array<int, 3> from{}, to{};
    for (int axis = 0; axis < 3; ++axis) {
      from[axis] = std::max(0, static_cast<int>(std::ceil(low[axis] - kBand_cells)));
      to[axis] =
          std::min(field.size_[axis] - 1, static_cast<int>(std::floor(high[axis] + kBand_cells)));
    }
    for (int k = from[2]; k <= to[2]; ++k) {
      for (int j = from[1]; j <= to[1]; ++j) {
        for (int i = from[0]; i <= to[0]; ++i) {
          Offer(i, j, k, ClosestOnTriangle(Node(i, j, k), a, b, c));
        }
      }
    }
  }

  void Offer(int i, int j, int k, const Vector3f& point) {
    const std::size_t index = field.Index(i, j, k);
    const float distance = (Node(i, j, k) - point).norm();
    if (distance >= field.values_[index]) return;
    field.values_[index] = distance;
    nearest[index] = point;
  }

  // Nearest points spread from node to node, forwards and backwards.
  void Spread() {
    constexpr int kRounds = 2;
    for (int round = 0; round < kRounds; ++round) {
      for (const int step : {1, -1}) {
        const auto [nx, ny, nz] = field.size_;
        for (int k = step > 0 ? 0 : nz - 1; k >= 0 && k < nz; k += step) {
          for (int j = step > 0 ? 0 : ny - 1; j >= 0 && j < ny; j += step) {
            for (int i = step > 0 ? 0 : nx - 1; i >= 0 && i < nx; i += step) {
              OfferFromBefore(i, j, k, step);
            }
          }
        }
      }
    }
  }

  // What the neighbours that a scan has passed hold as their nearest points.
  void OfferFromBefore(int i, int j, int k, int step) {
    for (int dk = -1; dk <= 0; ++dk) {
      for (int dj = -1; dj <= (dk < 0 ? 1 : 0); ++dj) {
        for (int di = -1; di <= (dk < 0 || dj < 0 ? 1 : -1); ++di) {
          const int a = i + step * di, b = j + step * dj, c = k + step * dk;
          if (a < 0 || b < 0 || c < 0 || a >= field.size_[0] || b >= field.size_[1] ||
              c >= field.size_[2]) {
            continue;
          }
          const Vector3f& point = nearest[field.Index(a, b, c)];
          if (point.x() < kInfinite) Offer(i, j, k, point);
        }
      }
    }
  }

  // Counts, with its direction, where the triangle cuts the grid's lines along x.
  void CountCrossings(const Vector3f& a, const Vector3f& b, const Vector3f& c) {
    // Off the lattice, so that no line meets an edge.
    const Vector3d shift = Vector3d(0.0, 1.7e-6, 2.3e-6) + field.origin_.cast<double>();
    const auto in_cells = [&](const Vector3f& p) {
      return Vector3d((p.cast<double>() - shift) / double{cell});
    };
    const Vector3d p = in_cells(a), q = in_cells(b), r = in_cells(c);
    const double area = (q.y() - p.y()) * (r.z() - p.z()) - (q.z() - p.z()) * (r.y() - p.y());
    if (area == 0.0) return;
    const auto [low_y, high_y] = std::minmax({p.y(), q.y(), r.y()});
    const auto [low_z, high_z] = std::minmax({p.z(), q.z(), r.z()});
    const int last_j = std::min(field.size_[1] - 1, static_cast<int>(std::floor(high_y)));
    const int last_k = std::min(field.size_[2] - 1, static_cast<int>(std::floor(high_z)));
    for (int k = std::max(0, static_cast<int>(std::ceil(low_z))); k <= last_k; ++k) {
      for (int j = std::max(0, static_cast<int>(std::ceil(low_y))); j <= last_j; ++j) {
        const auto share = [&](const Vector3d& from, const Vector3d& to) {
          return ((to.y() - from.y()) * (k - from.z()) - (to.z() - from.z()) * (j - from.y())) /
                 area;
        };
        const double of_r = share(p, q), of_p = share(q, r), of_q = share(r, p);
        if (of_p < 0.0 || of_q < 0.0 || of_r < 0.0) continue;
        const double x = of_p * p.x() + of_q * q.x() + of_r * r.x();
        const int i = std::clamp(static_cast<int>(std::ceil(x)), 0, field.size_[0] - 1);
        winding[field.Index(i, j, k)] += area > 0.0 ? -1 : 1;
      }
    }
  }

  // A line enters the body where the surface faces against it.
  void Sign() {
    for (int k = 0; k < field.size_[2]; ++k) {
      for (int j = 0; j < field.size_[1]; ++j) {
        int inside = 0;
        for (int i = 0; i < field.size_[0]; ++i) {
          const std::size_t index = field.Index(i, j, k);
          inside += winding[index];
          if (inside > 0) field.values_[index] = -field.values_[index];
        }
      }
    }
  }

  DistanceField& field;
  float cell;
  std::vector<Vector3f> nearest;  // surface point, of each node
  std::vector<int> winding;       // how many times more a line enters than leaves before the node
};

DistanceField::DistanceField(const TriangleMesh& closed, double cell_m, double margin_m)
    : inverse_cell_(static_cast<float>(1.0 / cell_m)) {
  Eigen::AlignedBox3f box = BoundingBox(closed.vertices);
  const auto margin = static_cast<float>(margin_m);
  origin_ = box.min() - Vector3f::Constant(margin);
  for (int axis = 0; axis < 3; ++axis) {
    const float extent = box.sizes()[axis] + 2.0f * margin;
    size_[axis] = static_cast<int>(std::ceil(extent * inverse_cell_)) + 1;
    last_[axis] = static_cast<float>(size_[axis] - 1);
  }
  values_.assign(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2], kInfinite);
  Builder builder(*this, cell_m);
  for (const Triangle& t : closed.triangles) {
    const Vector3f &a = closed.vertices[t[0]], &b = closed.vertices[t[1]],
                   &c = closed.vertices[t[2]];
    builder.AddTriangle(a, b, c);
    builder.CountCrossings(a, b, c);
  }
  builder.Spread();
  builder.Sign();
}

// The eight nodes of a cell, and where in it a point lies.
struct DistanceField::Cell {
  Cell(const DistanceField& field, const Vector3f& x) {
    const Vector3f cell = (x - field.origin_) * field.inverse_cell_;
    const int i = static_cast<int>(cell.x()), j = static_cast<int>(cell.y()),
              k = static_cast<int>(cell.z());
    share = cell - Vector3f(static_cast<float>(i), static_cast<float>(j), static_cast<float>(k));
    const float* at = &field.values_[field.Index(i, j, k)];
    const std::size_t row = field.size_[0], layer = row * field.size_[1];
    value = {at[0],     at[1],         at[row],         at[row + 1],
             at[layer], at[layer + 1], at[layer + row], at[layer + row + 1]};
  }
  Vector3f share;
  std::array<float, 8> value;  // x fastest, then y
};

DistanceField::Sample DistanceField::At(const Vector3f& x) const {
  const Cell c(*this, x);
  const auto& [v000, v100, v010, v110, v001, v101, v011, v111] = c.value;
  const float fx = c.share.x(), fy = c.share.y(), fz = c.share.z();
  const float v00 = Mix(v000, v100, fx), v10 = Mix(v010, v110, fx);
  const float v01 = Mix(v001, v101, fx), v11 = Mix(v011, v111, fx);
  const float v0 = Mix(v00, v10, fy), v1 = Mix(v01, v11, fy);
  const float along_x =
      Mix(Mix(v100 - v000, v110 - v010, fy), Mix(v101 - v001, v111 - v011, fy), fz);
  const float along_y = Mix(v10 - v00, v11 - v01, fz);
  return {Mix(v0, v1, fz), inverse_cell_ * Vector3f(along_x, along_y, v1 - v0)};
}

float DistanceField::DistanceAt(const Vector3f& x) const {
  const Cell c(*this, x);
  const auto& [v000, v100, v010, v110, v001, v101, v011, v111] = c.value;
  const float fx = c.share.x(), fy = c.share.y(), fz = c.share.z();
  return Mix(Mix(Mix(v000, v100, fx), Mix(v010, v110, fx), fy),
             Mix(Mix(v001, v101, fx), Mix(v011, v111, fx), fy), fz);
}

}  // namespace vitruvia::sdf_parts
