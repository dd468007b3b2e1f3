// Normals of a depth image's surface at a cloud's points.
#pragma once

#include <vector>

#include "geometry/point_cloud.h"

namespace vitruvia::articulated {

// For each point the unit normal towards the camera, from the pixels `step_px` to its left, right,
// top and bottom; zero where they do not lie on one surface with it.
void FindNormals(const PointCloud& cloud, const DepthImage& depth, const PinholeCamera& camera,
                 int step_px, std::vector<Vector3f>& normals);

}  // namespace vitruvia::articulated
