#include "bound/surface_samples.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace vitruvia {
namespace {

// Columns or rows whose centres lie between two coordinates, within the image.
struct Range {
  int first, last;
};
Range CentersBetween(double low, double high, int size) {
  return {std::max(static_cast<int>(std::ceil(low)), 0),
          std::min(static_cast<int>(std::floor(high)), size - 1)};
}

}  // namespace

Image<SurfaceSample> SampleSurface(const std::vector<Vector3f>& vertices,
                                   const std::vector<Triangle>& triangles,
                                   const PinholeCamera& camera) {
  Image<SurfaceSample> samples(camera.width, camera.height);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    Matrix3<double> corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = vertices[triangles[t][k]].cast<double>();
    // Negative for a triangle that is seen from outside, 0 for one that is seen edge-on.
    if (!(corners.determinant() < 0.0) || corners.row(2).minCoeff() <= 0.0) continue;
    const Matrix3<double> corner_shares = corners.inverse();
    Eigen::Matrix<double, 2, 3> places;
    for (int k = 0; k < 3; ++k) places.col(k) = camera.Project<double>(corners.col(k));
    const Range columns =
        CentersBetween(places.row(0).minCoeff(), places.row(0).maxCoeff(), camera.width);
    const Range rows =
        CentersBetween(places.row(1).minCoeff(), places.row(1).maxCoeff(), camera.height);
    for (int v = rows.first; v <= rows.last; ++v) {
      for (int u = columns.first; u <= columns.last; ++u) {
        // The point at depth z of the ray is Σ λ_k corner_k with Σ λ_k = 1, so λ / z solves this.
        const Vector3d shares = corner_shares * camera.Unproject<double>(u, v, 1.0);
        if (shares.minCoeff() < 0.0) continue;
        const double depth_m = 1.0 / shares.sum();
        SurfaceSample& sample = samples(u, v);
        if (sample.depth_m > 0.0f && sample.depth_m <= depth_m) continue;
        const Vector3f barycentric = (depth_m * shares).cast<float>();
        sample = {static_cast<float>(depth_m),
                  static_cast<int>(t),
                  {barycentric[0], barycentric[1], barycentric[2]}};
      }
    }
  }
  return samples;
}

DepthImage DepthOf(const Image<SurfaceSample>& samples) {
  DepthImage depth(samples.width(), samples.height());
  std::transform(samples.pixels().begin(), samples.pixels().end(), depth.pixels().begin(),
                 [](const SurfaceSample& sample) { return sample.depth_m; });
  return depth;
}

}  // namespace vitruvia
