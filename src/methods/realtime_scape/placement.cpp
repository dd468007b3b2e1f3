#include "methods/realtime_scape/placement.h"

#include <algorithm>
#include <limits>

#include "math/angles.h"
#include "math/rigid_fit.h"
#include "search/kd_tree.h"
#include "tracking/visibility.h"

namespace vitruvia::realtime_scape {
namespace {

struct Match {
  Vector3d rest;      // subject frame
  Vector3d observed;  // camera frame
  float squared_distance;
};

Vector3d Mean(const std::vector<Vector3f>& points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3f& p : points) sum += p.cast<double>();
  return sum / static_cast<double>(points.size());
}

Rigidd RigidFit(const std::vector<Match>& matches) {
  return FitRigid(matches.size(), [&](std::size_t i) {
    return PointPair{matches[i].rest, matches[i].observed};
  });
}

std::vector<Vector3f> Transformed(const std::vector<Vector3f>& points, const Rigidf& b_from_a) {
  std::vector<Vector3f> result(points.size());
  std::transform(points.begin(), points.end(), result.begin(),
                 [&](const Vector3f& p) { return b_from_a * p; });
  return result;
}

void KeepBest(double share, std::vector<Match>& matches) {
  const auto keep = static_cast<std::ptrdiff_t>(share * static_cast<double>(matches.size()));
  if (keep < 3) return;
  std::nth_element(
      matches.begin(), matches.begin() + keep, matches.end(),
      [](const Match& a, const Match& b) { return a.squared_distance < b.squared_distance; });
  matches.resize(keep);
}

Rigidd Misplaced(const Rigidd& camera_from_subject, const PlacementSettings& settings) {
  const double angle = settings.wrong_by_deg * kRadiansPerDegree;
  const Vector3d shift(settings.wrong_by_m[0], settings.wrong_by_m[1], settings.wrong_by_m[2]);
  return Rigidd{Matrix3<double>::Identity(), shift} * camera_from_subject *
         Rigidd{ExpSo3<double>({0.0, angle, 0.0}), Vector3d::Zero()};
}

}  // namespace

Rigidd PlaceRestPose(const Model& model, const PointCloud& cloud, const PinholeCamera& camera,
                     const FitSettings& fit, const PlacementSettings& settings,
                     MeshRasterizer& rasterizer) {
  // Facing the camera: the subject's up is the image's up, its front looks back along the view.
  Rigidd camera_from_subject;
  camera_from_subject.rotation = Vector3d(1.0, -1.0, -1.0).asDiagonal();
  camera_from_subject.translation =
      Mean(cloud.points) - camera_from_subject.rotation * Mean(model.rest_vertices);

  camera_from_subject = Misplaced(camera_from_subject, settings);

  KdTree tree;
  std::vector<int> visible;
  std::vector<KdTree::Neighbor> neighbors;
  std::vector<Match> matches;
  for (int i = 0; i < settings.iterations; ++i) {
    const std::vector<Vector3f> posed =
        Transformed(model.rest_vertices, camera_from_subject.Cast<float>());
    FindVisibleVertices(posed, rasterizer.Render(posed, model.triangles), camera,
                        static_cast<float>(fit.visible_within_m), visible);
    std::vector<Vector3f> visible_positions;
    for (const int v : visible) visible_positions.push_back(posed[v]);
    if (visible.size() < 3) break;
    tree.Build(visible_positions);
    tree.FindNearest(cloud.points, std::numeric_limits<float>::infinity(), neighbors);
    matches.clear();
    for (std::size_t k = 0; k < neighbors.size(); ++k) {
      if (neighbors[k].index < 0) continue;
      matches.push_back({model.rest_vertices[visible[neighbors[k].index]].cast<double>(),
                         cloud.points[k].cast<double>(), neighbors[k].squared_distance});
    }
    KeepBest(1.0 - settings.trim, matches);
    if (matches.size() < 3) break;
    camera_from_subject = RigidFit(matches);
  }
  return camera_from_subject;
}

}  // namespace vitruvia::realtime_scape
