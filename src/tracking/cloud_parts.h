// Connected parts of a frame's point cloud.
#pragma once

#include <vector>

#include "geometry/point_cloud.h"

namespace vitruvia {

// The mean of each part of the cloud that holds at least `min_share` of its points, the largest
// part first (camera frame, metres). Points belong to one part if they are neighbours in columns or
// rows of the cloud's stride and their depths differ by less than gap_m. `width` is the image's.
std::vector<Vector3d> CentersOfParts(const PointCloud& cloud, int width, int stride, double gap_m,
                                     double min_share);

}  // namespace vitruvia
