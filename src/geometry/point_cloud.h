// Conversion of depth images to point clouds, and interpolation of depth at sub-pixel positions.
#pragma once

#include <vector>

#include "geometry/camera.h"
#include "geometry/image.h"
#include "geometry/mesh.h"
#include "math/lanes.h"

namespace vitruvia {

// Points of the measured pixels whose column and row are multiples of `stride`.
struct PointCloud {
  std::vector<Vector3f> points;  // N, camera frame, metres
  std::vector<int> pixels;       // N, v · width + u
};
// Pixels that are NaN, not positive or beyond max_depth_m are treated as not measured.
void CloudFromDepth(const DepthImage& depth, const PinholeCamera& camera, int stride,
                    float max_depth_m, PointCloud& cloud);

// Depth at (u, v): bilinear where the four neighbours are measured and lie within
// `smooth_within_m` of each other, the nearest pixel's elsewhere. 0: no measurement there.
float SampleDepth(const DepthImage& depth, float u, float v, float smooth_within_m);
// The same at eight positions.
FloatLanes SampleDepth(const DepthImage& depth, const FloatLanes& u, const FloatLanes& v,
                       float smooth_within_m);

}  // namespace vitruvia
