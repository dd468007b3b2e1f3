// Surface normals of a depth image at the points of its cloud.
#pragma once

#include <vector>

#include "geometry/point_cloud.h"

namespace vitruvia::articulated {

// For each point the unit normal towards the camera, from the pixels at distance `step_px` to its
// left, right, top and bottom; zero if these do not lie on the same surface as the point.
void FindNormals(const PointCloud& cloud, const DepthImage& depth, const PinholeCamera& camera,
                 int step_px, std::vector<Vector3f>& normals);

}  // namespace vitruvia::articulated
