#include "metrics/reconstruction_error.h"

#include <cmath>
#include <limits>

#include "geometry/surface_map.h"
#include "search/kd_tree.h"

namespace vitruvia {
namespace {

// Distances of the finite points by `measure`, in the place of each; the others are infinitely far.
template <class Measure>
std::vector<double> OfFinitePoints(const std::vector<Vector3f>& points, const Measure& measure) {
  std::vector<double> distances(points.size(), std::numeric_limits<double>::infinity());
  std::vector<Vector3f> finite;
  std::vector<std::size_t> place;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) continue;
    finite.push_back(points[i]);
    place.push_back(i);
  }
  const std::vector<double> measured = measure(finite);
  for (std::size_t k = 0; k < place.size(); ++k) distances[place[k]] = measured[k];
  return distances;
}

}  // namespace

std::vector<double> DistancesToPoints(const std::vector<Vector3f>& points,
                                      const std::vector<Vector3f>& observed) {
  KdTree tree;
  tree.Build(observed);
  return OfFinitePoints(points, [&](const std::vector<Vector3f>& finite) {
    std::vector<KdTree::Neighbor> neighbors;
    tree.FindNearest(finite, std::numeric_limits<float>::infinity(), neighbors);
    std::vector<double> distances;
    for (const KdTree::Neighbor& neighbor : neighbors) {
      distances.push_back(neighbor.index < 0 ? std::numeric_limits<double>::infinity()
                                             : std::sqrt(double{neighbor.squared_distance}));
    }
    return distances;
  });
}

std::vector<double> DistancesToSurface(const std::vector<Vector3f>& points,
                                       const TriangleMesh& surface) {
  return OfFinitePoints(points, [&](const std::vector<Vector3f>& finite) {
    const std::vector<SurfacePoint> nearest = ClosestSurfacePoints(finite, surface);
    std::vector<double> distances;
    for (std::size_t i = 0; i < finite.size(); ++i) {
      const Vector3f place = Evaluate(nearest[i], surface.vertices.data(), surface.triangles);
      distances.push_back((finite[i].cast<double>() - place.cast<double>()).norm());
    }
    return distances;
  });
}

}  // namespace vitruvia
