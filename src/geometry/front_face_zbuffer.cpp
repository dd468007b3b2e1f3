#include "geometry/front_face_zbuffer.h"

#include <algorithm>
#include <cmath>

namespace vitruvia {

FrontFaceZBuffer::FrontFaceZBuffer(const PinholeCamera& camera, float near_m)
    : camera_(camera), near_m_(near_m), depth_(camera.width, camera.height) {}

const DepthImage& FrontFaceZBuffer::Render(const std::vector<Vector3f>& vertices_in_camera,
                                           const std::vector<Triangle>& triangles) & {
  Clear(drawn_);
  drawn_ = Project(vertices_in_camera);
  if (drawn_.empty()) return depth_;
  // The buffer holds 1/z while triangles are drawn (larger is nearer, 0 is empty).
  for (const Triangle& t : triangles) {
    const Corner &a = corners_[t[0]], &b = corners_[t[1]], &c = corners_[t[2]];
    // Seen from outside the corners run counter-clockwise; the image's v points down.
    const float area = (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
    if (area < 0.0f) DrawFrontFace(a, b, c);
  }
  Invert(drawn_);
  return depth_;
}

FrontFaceZBuffer::Box FrontFaceZBuffer::Project(const std::vector<Vector3f>& vertices_in_camera) {
  corners_.resize(vertices_in_camera.size());
  const auto fx = static_cast<float>(camera_.fx), fy = static_cast<float>(camera_.fy);
  const auto cx = static_cast<float>(camera_.cx), cy = static_cast<float>(camera_.cy);
  const auto last_u = static_cast<float>(camera_.width - 1);
  const auto last_v = static_cast<float>(camera_.height - 1);
  float low_u = last_u + 1.0f, low_v = last_v + 1.0f, high_u = -1.0f, high_v = -1.0f;
  for (std::size_t i = 0; i < vertices_in_camera.size(); ++i) {
    const Vector3f& p = vertices_in_camera[i];
    const float inverse_z = p.z() > near_m_ ? 1.0f / p.z() : 0.0f;
    const Corner corner{fx * p.x() * inverse_z + cx, fy * p.y() * inverse_z + cy, inverse_z};
    corners_[i] = corner;
    low_u = std::min(low_u, corner.u);
    high_u = std::max(high_u, corner.u);
    low_v = std::min(low_v, corner.v);
    high_v = std::max(high_v, corner.v);
  }
  // Clipped as floats: far outside the image the numbers do not fit an int.
  return {static_cast<int>(std::max(low_u, 0.0f)), static_cast<int>(std::max(low_v, 0.0f)),
          static_cast<int>(std::min(std::max(high_u, -1.0f), last_u)),
          static_cast<int>(std::min(std::max(high_v, -1.0f), last_v))};
}

void FrontFaceZBuffer::DrawFrontFace(const Corner& a, const Corner& b, const Corner& c) {
  // Pixel centres inside the bounding box; most triangles of a body mesh cover none or one.
  const auto last_u = static_cast<float>(camera_.width - 1);
  const auto last_v = static_cast<float>(camera_.height - 1);
  const float low_u = std::max(std::ceil(std::min(std::min(a.u, b.u), c.u)), 0.0f);
  const float high_u = std::min(std::floor(std::max(std::max(a.u, b.u), c.u)), last_u);
  const float low_v = std::max(std::ceil(std::min(std::min(a.v, b.v), c.v)), 0.0f);
  const float high_v = std::min(std::floor(std::max(std::max(a.v, b.v), c.v)), last_v);
  if (!(low_u <= high_u) || !(low_v <= high_v)) return;
  if (a.inverse_z <= 0.0f || b.inverse_z <= 0.0f || c.inverse_z <= 0.0f) return;

  // Barycentric coordinates and 1/z are affine in the pixel.
  const float area = (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
  const float inverse_area = 1.0f / area;
  const float b_du = (c.v - a.v) * inverse_area, b_dv = -(c.u - a.u) * inverse_area;
  const float c_du = -(b.v - a.v) * inverse_area, c_dv = (b.u - a.u) * inverse_area;
  const int first_u = static_cast<int>(low_u), end_u = static_cast<int>(high_u);
  for (int v = static_cast<int>(low_v); v <= static_cast<int>(high_v); ++v) {
    const float dv = static_cast<float>(v) - a.v;
    float* row = &depth_(0, v);
    for (int u = first_u; u <= end_u; ++u) {
      const float du = static_cast<float>(u) - a.u;
      const float weight_b = du * b_du + dv * b_dv;
      const float weight_c = du * c_du + dv * c_dv;
      const float weight_a = 1.0f - weight_b - weight_c;
      if (std::min(std::min(weight_a, weight_b), weight_c) < 0.0f) continue;
      const float inverse_z =
          weight_a * a.inverse_z + weight_b * b.inverse_z + weight_c * c.inverse_z;
      row[u] = std::max(row[u], inverse_z);
    }
  }
}

void FrontFaceZBuffer::Clear(const Box& box) {
  for (int v = box.top; v <= box.bottom; ++v) {
    std::fill(&depth_(0, v) + box.left, &depth_(0, v) + box.right + 1, 0.0f);
  }
}

void FrontFaceZBuffer::Invert(const Box& box) {
  for (int v = box.top; v <= box.bottom; ++v) {
    float* row = &depth_(0, v);
    for (int u = box.left; u <= box.right; ++u) row[u] = row[u] > 0.0f ? 1.0f / row[u] : 0.0f;
  }
}

}  // namespace vitruvia
