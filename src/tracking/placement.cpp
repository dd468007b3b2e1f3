#include "tracking/placement.h"

#include <algorithm>
#include <limits>

#include "geometry/point_sets.h"
#include "math/angles.h"
#include "math/rigid.h"
#include "math/rigid_fit.h"
#include "math/rotation.h"
#include "search/kd_tree.h"
#include "tracking/visibility.h"

namespace vitruvia {
namespace {

struct Match {
  Vector3d rest;      // subject frame
  Vector3d observed;  // camera frame
  float squared_distance;
};

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

Rigidd Displaced(const Rigidd& camera_from_subject, const PlacementSettings& settings) {
  const double angle = settings.initial_rotation_deg * kRadiansPerDegree;
  const auto& [x, y, z] = settings.initial_offset_m;
  return Rigidd{Matrix3<double>::Identity(), {x, y, z}} * camera_from_subject *
         Rigidd{ExpSo3<double>({0.0, angle, 0.0}), Vector3d::Zero()};
}

// Facing the camera: the subject's up is the image's up, its front looks back along the view.
Rigidd CentroidOnCentroid(const RestSurface& rest, const PointCloud& cloud) {
  const Matrix3<double> rotation = Vector3d(1.0, -1.0, -1.0).asDiagonal();
  return {rotation, Centroid(cloud.points) - rotation * Centroid(rest.vertices)};
}

}  // namespace

void PlacementSettings::Describe(Fields& f) {
  f.Integer(
      "iterations", iterations,
      {.meaning = "number of rigid ICP iterations that align the rest pose with the first frame",
       .min = 0,
       .max = 1000,
       .origin = Origin::kGuessed,
       .source = "paper A: the subject starts in a predetermined T-pose"});
  f.Number("trim", trim,
           {.meaning = "share of the pairs, those with the largest distances, left out of each "
                       "rigid fit of the first placement",
            .min = 0,
            .max = 0.9,
            .origin = Origin::kGuessed,
            .source = "the arms may hang a little from the T-pose"});
  f.Numbers("initial_offset_m", initial_offset_m,
            {.meaning = "translation in the camera frame that displaces the start of the first "
                        "placement, to test its basin of convergence",
             .unit = "m",
             .min = -10,
             .max = 10});
  f.Number("initial_rotation_deg", initial_rotation_deg,
           {.meaning = "rotation about the subject's vertical axis that displaces the start of the "
                       "first placement, to test its basin of convergence",
            .unit = "deg",
            .min = -180,
            .max = 180});
}

Rigidd PlaceRestPose(const RestSurface& rest, const PointCloud& cloud, const PinholeCamera& camera,
                     double visible_within_m, const PlacementSettings& settings,
                     MeshRasterizer& rasterizer) {
  Rigidd camera_from_subject = Displaced(CentroidOnCentroid(rest, cloud), settings);

  KdTree tree;
  std::vector<int> visible;
  std::vector<KdTree::Neighbor> neighbors;
  std::vector<Match> matches;
  for (int i = 0; i < settings.iterations; ++i) {
    const std::vector<Vector3f> posed =
        Transformed(rest.vertices, camera_from_subject.Cast<float>());
    FindVisibleVertices(posed, rasterizer.Render(posed, rest.triangles), camera,
                        static_cast<float>(visible_within_m), visible);
    std::vector<Vector3f> visible_positions;
    for (const int v : visible) visible_positions.push_back(posed[v]);
    if (visible.size() < 3) break;
    tree.Build(visible_positions);
    tree.FindNearest(cloud.points, std::numeric_limits<float>::infinity(), neighbors);
    matches.clear();
    for (std::size_t k = 0; k < neighbors.size(); ++k) {
      if (neighbors[k].index < 0) continue;
      matches.push_back({rest.vertices[visible[neighbors[k].index]].cast<double>(),
                         cloud.points[k].cast<double>(), neighbors[k].squared_distance});
    }
    KeepBest(1.0 - settings.trim, matches);
    if (matches.size() < 3) break;
    camera_from_subject = RigidFit(matches);
  }
  return camera_from_subject;
}

}  // namespace vitruvia
