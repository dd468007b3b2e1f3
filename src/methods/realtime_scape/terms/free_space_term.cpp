#include "methods/realtime_scape/terms/free_space_term.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "methods/realtime_scape/terms/fit_term.h"
#include "methods/realtime_scape/terms/posed_vertex.h"

namespace vitruvia::realtime_scape {
namespace {

// The measured pixel nearest to the unmeasured pixel `from`, at most reach_px away.
std::optional<Pixel> NearestMeasured(const DepthImage& captured, Pixel from, int reach_px) {
  std::optional<Pixel> nearest;
  int nearest_squared = std::numeric_limits<int>::max();
  const auto look = [&](int u, int v) {
    if (!captured.Contains(u, v) || captured(u, v) <= 0.0f) return;
    const int du = u - from.u, dv = v - from.v, squared = du * du + dv * dv;
    if (squared < nearest_squared) {
      nearest_squared = squared;
      nearest = {u, v};
    }
  };
  // Squares round the pixel, until no farther one can hold a nearer measurement.
  for (int r = 1; r <= reach_px && r * r < nearest_squared; ++r) {
    for (int k = -r; k <= r; ++k) {
      look(from.u + k, from.v - r);
      look(from.u + k, from.v + r);
      look(from.u - r, from.v + k);
      look(from.u + r, from.v + k);
    }
  }
  return nearest;
}

}  // namespace

void FindFreeSpace(const std::vector<Vector3f>& vertices, const VertexClasses& classes,
                   const DepthImage& captured, const PinholeCamera& camera,
                   const FitSettings& settings, FreeSpace& free_space) {
  free_space.ways_out.clear();
  for (const int i : classes.elsewhere) {
    const Vector3f& vertex = vertices[i];
    const auto at = camera.PixelOf(vertex);
    if (!at) continue;
    const float measured = captured(at->u, at->v);
    if (measured > 0.0f) {
      if (vertex.z() < measured) {
        free_space.ways_out.push_back({i, vertex * (measured / vertex.z())});
      }
      continue;
    }
    const float z = vertex.z();
    const int reach_px = static_cast<int>(settings.free_space.reach_m * camera.fx / double{z});
    const auto edge = NearestMeasured(captured, *at, reach_px);
    if (!edge || std::max(std::abs(edge->u - at->u), std::abs(edge->v - at->v)) <=
                     settings.free_space.margin_px) {
      continue;
    }
    free_space.ways_out.push_back(
        {i, camera.Unproject(static_cast<float>(edge->u), static_cast<float>(edge->v), z)});
  }
}

void AddFreeSpaceTerm(const Model& model, const BodyPose& pose, const FreeSpace& free_space,
                      const FitSettings& settings, double weight, double length_unit_m,
                      BlockNormalEquations& equations) {
  const double per_unit = 1.0 / length_unit_m;
  for (const Pair& way_out : free_space.ways_out) {
    const PosedVertex vertex(model, pose, way_out.vertex);
    const Vector3d target = way_out.target.cast<double>();
    const Vector3d offset = vertex.position() - target;
    const double distance_m = offset.norm();
    if (distance_m == 0.0) continue;
    const Vector3d direction = offset / distance_m;
    const double noise_weight = NoiseWeight(settings.noise, target, direction);
    const double robust = RobustWeight(settings.kernel, distance_m * std::sqrt(noise_weight),
                                       settings.kernel_scale_m);
    vertex.AddRow(direction, distance_m, weight * noise_weight * robust, per_unit, equations);
  }
}

}  // namespace vitruvia::realtime_scape
