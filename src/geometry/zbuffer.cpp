#include "geometry/zbuffer.h"

#include <algorithm>
#include <cmath>

namespace vitruvia {

ZBuffer::ZBuffer(const PinholeCamera& camera, float near_m)
    : camera_(camera), near_m_(near_m), depth_(camera.width, camera.height) {}

const DepthImage& ZBuffer::Render(const std::vector<Vector3f>& vertices_in_camera,
                                  const std::vector<Triangle>& triangles) & {
  Project(vertices_in_camera);
  // The buffer holds 1/z while triangles are drawn (larger is nearer, 0 is empty).
  std::fill(depth_.pixels().begin(), depth_.pixels().end(), 0.0f);
  for (const Triangle& triangle : triangles) DrawTriangle(triangle);
  for (float& pixel : depth_.pixels()) pixel = pixel > 0.0f ? 1.0f / pixel : 0.0f;
  return depth_;
}

void ZBuffer::Project(const std::vector<Vector3f>& vertices_in_camera) {
  projected_.resize(vertices_in_camera.size());
  const auto fx = static_cast<float>(camera_.fx), fy = static_cast<float>(camera_.fy);
  const auto cx = static_cast<float>(camera_.cx), cy = static_cast<float>(camera_.cy);
  for (std::size_t i = 0; i < vertices_in_camera.size(); ++i) {
    const Vector3f& p = vertices_in_camera[i];
    const float inverse_z = p.z() > near_m_ ? 1.0f / p.z() : 0.0f;
    projected_[i] = {fx * p.x() * inverse_z + cx, fy * p.y() * inverse_z + cy, inverse_z};
  }
}

void ZBuffer::DrawTriangle(const Triangle& triangle) {
  const Vector3f& a = projected_[triangle[0]];
  const Vector3f& b = projected_[triangle[1]];
  const Vector3f& c = projected_[triangle[2]];
  if (a.z() <= 0.0f || b.z() <= 0.0f || c.z() <= 0.0f) return;

  // Pixel centres inside the bounding box; most triangles of a body mesh cover none or one. The box
  // is clipped as floats: far outside the image the numbers do not fit an int.
  const auto last_u = static_cast<float>(camera_.width - 1);
  const auto last_v = static_cast<float>(camera_.height - 1);
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
    float* row = &depth_(0, v);
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

}  // namespace vitruvia
