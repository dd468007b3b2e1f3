// The reference of ZBuffer: triangle after triangle, pixel after pixel.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/camera.h"
#include "geometry/image.h"
#include "geometry/mesh.h"

namespace vitruvia {

// u, v and 1/z; 1/z is 0 for a point nearer than near_m.
inline Vector3f ScalarProjection(const PinholeCamera& camera, const Vector3f& p, float near_m) {
  const auto fx = static_cast<float>(camera.fx), fy = static_cast<float>(camera.fy);
  const auto cx = static_cast<float>(camera.cx), cy = static_cast<float>(camera.cy);
  const float inverse_z = p.z() > near_m ? 1.0f / p.z() : 0.0f;
  return {fx * p.x() * inverse_z + cx, fy * p.y() * inverse_z + cy, inverse_z};
}

// Draws the triangle of three projected points into an image of 1/z (larger is nearer, 0 is empty).
inline void DrawScalar(const PinholeCamera& camera, const Vector3f& a, const Vector3f& b,
                       const Vector3f& c, DepthImage& nearest) {
  if (a.z() <= 0.0f || b.z() <= 0.0f || c.z() <= 0.0f) return;

  // Pixel centres inside the bounding box; most triangles of a body mesh cover none or one. The box
  // is clipped as floats: far outside the image the numbers do not fit an int.
  const auto last_u = static_cast<float>(camera.width - 1);
  const auto last_v = static_cast<float>(camera.height - 1);
  const float low_u = std::max(std::ceil(std::min({a.x(), b.x(), c.x()})), 0.0f);
  const float high_u = std::min(std::floor(std::max({a.x(), b.x(), c.x()})), last_u);
  const float low_v = std::max(std::ceil(std::min({a.y(), b.y(), c.y()})), 0.0f);
  const float high_v = std::min(std::floor(std::max({a.y(), b.y(), c.y()})), last_v);
  if (!(low_u <= high_u) || !(low_v <= high_v)) return;

  const float area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  if (area == 0.0f) return;
  const float inverse_area = 1.0f / area;  // its sign makes both windings count as inside

  // Barycentric coordinates and 1/z are affine in the pixel: values at the box's corner and two
  // slopes.
  const float b_du = (c.y() - a.y()) * inverse_area, b_dv = -(c.x() - a.x()) * inverse_area;
  const float c_du = -(b.y() - a.y()) * inverse_area, c_dv = (b.x() - a.x()) * inverse_area;
  for (int v = static_cast<int>(low_v); v <= static_cast<int>(high_v); ++v) {
    const float dv = static_cast<float>(v) - a.y();
    float* row = &nearest(0, v);
    for (int u = static_cast<int>(low_u); u <= static_cast<int>(high_u); ++u) {
      const float du = static_cast<float>(u) - a.x();
      const float weight_b = du * b_du + dv * b_dv;
      const float weight_c = du * c_du + dv * c_dv;
      const float weight_a = 1.0f - weight_b - weight_c;
      if (weight_a < 0.0f || weight_b < 0.0f || weight_c < 0.0f) continue;
      const float inverse_z = weight_a * a.z() + weight_b * b.z() + weight_c * c.z();
      row[u] = std::max(row[u], inverse_z);
    }
  }
}

inline DepthImage RenderScalar(const PinholeCamera& camera, const TriangleMesh& mesh,
                               float near_m = 0.05f) {
  std::vector<Vector3f> projected;
  for (const Vector3f& p : mesh.vertices) projected.push_back(ScalarProjection(camera, p, near_m));
  DepthImage depth(camera.width, camera.height);
  for (const auto& [a, b, c] : mesh.triangles)
    DrawScalar(camera, projected[a], projected[b], projected[c], depth);
  for (float& pixel : depth.pixels()) pixel = pixel > 0.0f ? 1.0f / pixel : 0.0f;
  return depth;
}

}  // namespace vitruvia
