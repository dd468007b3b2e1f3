// First placement: aligns the rest pose with the first frame.
#pragma once

#include <array>
#include <vector>

#include "config/settings.h"
#include "geometry/mesh_rasterizer.h"
#include "geometry/point_cloud.h"

namespace vitruvia {

struct PlacementSettings {
  int iterations = 30;
  double trim = 0.2;
  std::array<double, 3> initial_offset_m{};  // camera frame
  double initial_rotation_deg = 0.0;         // about the subject's vertical axis

  void Describe(Fields& fields);
};

// The subject's surface in the rest pose (subject frame, metres; y is up, z to the front).
struct RestSurface {
  const std::vector<Vector3f>& vertices;
  const std::vector<Triangle>& triangles;
};

// camera_from_subject of a body that stands in the rest pose, upright and facing the camera: aligns
// the centroids, then runs trimmed rigid ICP between the cloud, which must not be empty, and the
// visible vertices. A vertex is visible within `visible_within_m` of the depth that `rasterizer`
// renders. The iterations start displaced by the settings' initial offset.
Rigidd PlaceRestPose(const RestSurface& rest, const PointCloud& cloud, const PinholeCamera& camera,
                     double visible_within_m, const PlacementSettings& settings,
                     MeshRasterizer& rasterizer);

}  // namespace vitruvia
