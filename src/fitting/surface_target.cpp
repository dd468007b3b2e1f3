#include "fitting/surface_target.h"

#include "core/error.h"
#include "fitting/distance_sum.h"

namespace vitruvia {
namespace {

constexpr float kLeastPairCosine = 0.2f;  // between the normals of a pair
constexpr float kInsideWeight = 0.25f;    // of a clothed body's vertex inside of the surface

}  // namespace

SurfaceTarget::SurfaceTarget(OrientedPoints points, int seekers, Clothing clothing)
    : points_(std::move(points)), clothing_(clothing) {
  Require(!points_.points.empty(), "SurfaceTarget: no points");
  seekers_ = EvenlyChosen(points_, seekers);
  centroid_ = Centroid(points_.points);
  tree_.Build(points_.points);
}

void SurfaceTarget::FindPairs(const PosedBody& body, double cutoff_m, std::vector<FitPair>& pairs) {
  const std::vector<Vector3f>& vertices = body.vertices();
  const auto cutoff = static_cast<float>(cutoff_m);
  const auto weight_of = [&](const Vector3f& inside_from, const Vector3f& surface,
                             const Vector3f& normal) {
    const bool is_inside = normal.dot(inside_from - surface) < 0.0f;
    return clothing_ == Clothing::kLoose && is_inside ? kInsideWeight : 1.0f;
  };
  pairs.clear();
  tree_.FindNearest(vertices, cutoff, neighbors_);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (neighbors_[v].index < 0) continue;
    const auto s = static_cast<std::size_t>(neighbors_[v].index);
    if (points_.normals[s].dot(body.normals()[v]) < kLeastPairCosine) continue;
    pairs.push_back({static_cast<int>(v), points_.points[s], points_.normals[s],
                     body.AreaShare(static_cast<int>(v)) *
                         weight_of(vertices[v], points_.points[s], points_.normals[s])});
  }
  body_tree_.Build(vertices);
  body_tree_.FindNearest(seekers_.points, cutoff, neighbors_);
  for (std::size_t q = 0; q < seekers_.points.size(); ++q) {
    if (neighbors_[q].index < 0) continue;
    const auto v = static_cast<std::size_t>(neighbors_[q].index);
    if (seekers_.normals[q].dot(body.normals()[v]) < kLeastPairCosine) continue;
    pairs.push_back({neighbors_[q].index, seekers_.points[q], body.normals()[v],
                     weight_of(vertices[v], seekers_.points[q], seekers_.normals[q])});
  }
}

MutualDistance SurfaceTarget::Measure(const PosedBody& body, const NearFar& limits) {
  const std::vector<Vector3f>& vertices = body.vertices();
  const auto far_m = static_cast<float>(limits.far_m);
  // Of a point from the one that was found nearest to it.
  const auto distance = [&](const Vector3f& point, const Vector3f& normal, int nearest,
                            const std::vector<Vector3f>& points,
                            const std::vector<Vector3f>& normals) {
    if (nearest < 0) return limits.far_m;
    const auto i = static_cast<std::size_t>(nearest);
    if (normals[i].dot(normal) <= kLeastPairCosine) return limits.far_m;
    return SurfaceDistance(point - points[i], normals[i], body.mean_edge_m());
  };
  DistanceSum from_body, from_target;
  tree_.FindNearest(vertices, far_m, neighbors_);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    from_body.Add(distance(vertices[v], body.normals()[v], neighbors_[v].index, points_.points,
                           points_.normals),
                  body.AreaShare(static_cast<int>(v)), limits);
  }
  body_tree_.Build(vertices);
  body_tree_.FindNearest(seekers_.points, far_m, neighbors_);
  for (std::size_t q = 0; q < seekers_.points.size(); ++q) {
    from_target.Add(distance(seekers_.points[q], seekers_.normals[q], neighbors_[q].index, vertices,
                             body.normals()),
                    1.0, limits);
  }
  return {from_target.MeanOr(limits.far_m), from_body.MeanOr(limits.far_m), from_target.share(),
          from_body.share()};
}

Vector3d SurfaceTarget::VisibleCenter(const PosedBody& body) { return Centroid(body.vertices()); }

}  // namespace vitruvia
