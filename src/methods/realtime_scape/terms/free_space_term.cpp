#include "methods/realtime_scape/terms/free_space_term.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "methods/realtime_scape/terms/fit_term.h"
#include "methods/realtime_scape/terms/posed_vertex.h"

namespace vitruvia::realtime_scape {
namespace {

int SquaredDistance(Pixel from, Pixel to) {
  const int du = to.u - from.u, dv = to.v - from.v;
  return du * du + dv * dv;
}

// In columns or rows, whichever are more.
int ChessboardDistance(Pixel from, Pixel to) {
  return std::max(std::abs(to.u - from.u), std::abs(to.v - from.v));
}

// The measured pixel nearest to the unmeasured pixel `from`, at most reach_px away.
std::optional<Pixel> NearestMeasured(const DepthImage& captured, Pixel from, int reach_px) {
  std::optional<Pixel> nearest;
  int nearest_squared = std::numeric_limits<int>::max();
  const auto look = [&](int u, int v) {
    if (!captured.Contains(u, v) || captured(u, v) <= 0.0f) return;
    const int squared = SquaredDistance(from, {u, v});
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

// The place beside the image that is nearest to a pixel of it.
Pixel NearestOutside(const DepthImage& image, Pixel from) {
  const int right = image.width() - from.u, below = image.height() - from.v;
  const int least = std::min({from.u + 1, right, from.v + 1, below});
  if (least == from.u + 1) return {-1, from.v};
  if (least == right) return {image.width(), from.v};
  return least == from.v + 1 ? Pixel{from.u, -1} : Pixel{from.u, image.height()};
}

Vector3f PlaceAt(const PinholeCamera& camera, Pixel pixel, float z) {
  return camera.Unproject(static_cast<float>(pixel.u), static_cast<float>(pixel.v), z);
}

// Out of the space before the captured surface: along the line of sight, or out of the image.
Vector3f WayOutBefore(const Vector3f& vertex, Pixel at, const DepthImage& captured,
                      const PinholeCamera& camera) {
  const Vector3f behind = vertex * (captured(at.u, at.v) / vertex.z());
  const Vector3f beside = PlaceAt(camera, NearestOutside(captured, at), vertex.z());
  return (beside - vertex).squaredNorm() < (behind - vertex).squaredNorm() ? beside : behind;
}

// Out of the space beside the captured surface: to the nearest measured pixel, or out of the image.
std::optional<Vector3f> WayOutBeside(const Vector3f& vertex, Pixel at, const DepthImage& captured,
                                     const PinholeCamera& camera,
                                     const FreeSpaceSettings& settings) {
  const int reach_px = static_cast<int>(settings.reach_m * camera.fx / double{vertex.z()});
  Pixel way_out = NearestOutside(captured, at);
  // What is farther away than the border cannot be nearest.
  const int search_px = std::min(reach_px, ChessboardDistance(at, way_out));
  if (const auto edge = NearestMeasured(captured, at, search_px);
      edge && SquaredDistance(at, *edge) <= SquaredDistance(at, way_out)) {
    way_out = *edge;
  }
  const int distance_px = ChessboardDistance(at, way_out);
  if (distance_px <= settings.margin_px || distance_px > reach_px) return {};
  return PlaceAt(camera, way_out, vertex.z());
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
      if (vertex.z() < measured)
        free_space.ways_out.push_back({i, WayOutBefore(vertex, *at, captured, camera)});
    } else if (const auto way_out =
                   WayOutBeside(vertex, *at, captured, camera, settings.free_space)) {
      free_space.ways_out.push_back({i, *way_out});
    }
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
