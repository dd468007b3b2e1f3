#include "metrics/vertex_error.h"

#include <cmath>
#include <limits>

#include "core/error.h"
#include "math/statistics.h"

namespace vitruvia {
RestCorrespondence::RestCorrespondence(const TriangleMesh& estimate_rest,
                                       const TriangleMesh& true_rest)
    : points_(ClosestSurfacePoints(estimate_rest.vertices, true_rest)),
      true_triangles_(true_rest.triangles) {}

std::vector<Vector3f> RestCorrespondence::TruePositions(
    const std::vector<Vector3f>& true_vertices) const {
  std::vector<Vector3f> positions;
  positions.reserve(points_.size());
  for (const SurfacePoint& point : points_) {
    positions.push_back(Evaluate(point, true_vertices.data(), true_triangles_));
  }
  return positions;
}

std::vector<double> VertexErrors(const std::vector<Vector3f>& estimate,
                                 const std::vector<Vector3f>& truth) {
  Require(estimate.size() == truth.size(), "VertexErrors: {} estimated and {} true vertices",
          estimate.size(), truth.size());
  std::vector<double> errors(estimate.size());
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const double distance = (estimate[i].cast<double>() - truth[i].cast<double>()).norm();
    errors[i] = std::isfinite(distance) ? distance : std::numeric_limits<double>::infinity();
  }
  return errors;
}

std::vector<bool> VisiblePoints(const std::vector<Vector3f>& points,
                                const DepthImage& rendered_truth, const PinholeCamera& camera,
                                double visible_within_m) {
  std::vector<bool> visible(points.size(), false);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3f& point = points[i];
    const auto pixel = camera.PixelOf(point);
    if (!pixel) continue;
    const float front = rendered_truth(pixel->u, pixel->v);
    visible[i] = front == 0.0f || double{point.z()} <= double{front} + visible_within_m;
  }
  return visible;
}

VertexErrorSummary Summarize(const std::vector<double>& errors_m,
                             const std::vector<bool>& visible) {
  Require(errors_m.size() == visible.size(), "Summarize: {} errors and {} visibility flags",
          errors_m.size(), visible.size());
  std::vector<double> seen, hidden;
  for (std::size_t i = 0; i < errors_m.size(); ++i)
    (visible[i] ? seen : hidden).push_back(errors_m[i]);
  return {MeanOrAbsent(errors_m), MaximumOrAbsent(errors_m), MeanOrAbsent(seen),
          MaximumOrAbsent(seen),  MeanOrAbsent(hidden),      MaximumOrAbsent(hidden)};
}

}  // namespace vitruvia
