#include "metrics/observation_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/absent.h"
#include "geometry/point_cloud.h"
#include "math/share.h"
#include "metrics/reconstruction_error.h"
#include "metrics/vertex_error.h"

namespace vitruvia {
namespace {

// Every n-th pixel of rows and columns, so that about so many points remain.
int StrideFor(const DepthImage& depth, int most_points) {
  const auto measured =
      std::count_if(depth.pixels().begin(), depth.pixels().end(), [](float z) { return z > 0.0f; });
  return std::max(
      1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(measured) / most_points))));
}

void CompareImages(const DepthImage& model, const DepthImage& person, const DepthImage& scene,
                   ObservationError& error) {
  long both = 0, either = 0, in_front = 0, measured_behind = 0;
  for (std::size_t i = 0; i < model.pixels().size(); ++i) {
    const bool has_model = model.pixels()[i] > 0.0f, has_person = person.pixels()[i] > 0.0f;
    both += has_model && has_person ? 1 : 0;
    either += has_model || has_person ? 1 : 0;
    if (!has_model || !(scene.pixels()[i] > 0.0f)) continue;
    ++measured_behind;
    in_front += scene.pixels()[i] - model.pixels()[i] > kUnexplainedAbove_m ? 1 : 0;
  }
  error.silhouette_overlap = ShareOr(both, either, kAbsent);
  error.model_in_front = ShareOr(in_front, measured_behind, kAbsent);
}

}  // namespace

ObservationError CompareWithObservation(const TriangleMesh& surface, const DepthImage& person,
                                        const DepthImage& scene, const PinholeCamera& camera,
                                        double visible_within_m, int most_points,
                                        ZBuffer& zbuffer) {
  constexpr float kAnyDepth = std::numeric_limits<float>::infinity();
  PointCloud all, some;
  CloudFromDepth(person, camera, 1, kAnyDepth, all);
  if (all.points.empty()) return {{}, {}, kAbsent, kAbsent, kAbsent};
  CloudFromDepth(person, camera, StrideFor(person, most_points), kAnyDepth, some);

  ObservationError error;
  const DepthImage& model = zbuffer.Render(surface.vertices, surface.triangles);
  CompareImages(model, person, scene, error);
  error.points_to_model_m = DistancesToSurface(some.points, surface);
  const std::vector<bool> visible =
      VisiblePoints(surface.vertices, model, camera, visible_within_m);
  std::vector<Vector3f> seen;
  for (std::size_t i = 0; i < visible.size(); ++i) {
    if (visible[i]) seen.push_back(surface.vertices[i]);
  }
  error.model_to_points_m = DistancesToPoints(seen, all.points);
  error.points_unexplained =
      ShareOr(std::count_if(error.points_to_model_m.begin(), error.points_to_model_m.end(),
                            [](double d) { return d > kUnexplainedAbove_m; }),
              error.points_to_model_m.size(), kAbsent);
  return error;
}

std::vector<Vector3f> PointsUnseen(const std::vector<Vector3f>& points_in_camera,
                                   const DepthImage& scene, const PinholeCamera& camera,
                                   double within_m) {
  std::vector<Vector3f> unseen;
  for (const Vector3f& point : points_in_camera) {
    const auto pixel = camera.PixelOf(point);
    const float front = pixel ? scene(pixel->u, pixel->v) : 0.0f;
    if (!pixel || (front > 0.0f && double{point.z()} > double{front} + within_m))
      unseen.push_back(point);
  }
  return unseen;
}

}  // namespace vitruvia
