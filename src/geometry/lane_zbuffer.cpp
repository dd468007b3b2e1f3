#include "geometry/lane_zbuffer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

#include "math/lanes.h"

namespace vitruvia {
namespace {

struct BoxLanes {  // of pixel centres, both ends included
  FloatLanes left, top, right, bottom;
};

}  // namespace

// Eight triangles side by side.
struct LaneZBuffer::TriangleLanes {
  struct CornerLanes {
    FloatLanes u, v, inverse_z;
  };
  CornerLanes a, b, c;

  TriangleLanes(const std::vector<Corner>& corners, const Triangle* triangles)
      : a(Gather(corners, triangles, 0)),
        b(Gather(corners, triangles, 1)),
        c(Gather(corners, triangles, 2)) {}

  // Twice the area. Seen from outside the corners run counter-clockwise and the image's v points
  // down: negative for front faces.
  FloatLanes Area() const { return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u); }

  // Clipped before rounding, because far outside the image the numbers do not fit an int.
  BoxLanes Boxes(const PinholeCamera& camera) const {
    const auto width = static_cast<float>(camera.width), height = static_cast<float>(camera.height);
    const auto low = [](const FloatLanes& x, float end) {
      return Ceil(Min(Max(x, FloatLanes{}), FloatLanes{} + end));
    };
    const auto high = [](const FloatLanes& x, float end) {
      return Floor(Max(Min(x, FloatLanes{} + (end - 1.0f)), FloatLanes{} - 1.0f));
    };
    return {.left = low(Min(Min(a.u, b.u), c.u), width),
            .top = low(Min(Min(a.v, b.v), c.v), height),
            .right = high(Max(Max(a.u, b.u), c.u), width),
            .bottom = high(Max(Max(a.v, b.v), c.v), height)};
  }

 private:
  // One load for each triangle, then a transposition in registers: numbers that are set lane by
  // lane go through memory.
  static CornerLanes Gather(const std::vector<Corner>& corners, const Triangle* triangles,
                            int corner) {
    const auto load = [&](int lane) {
      FloatQuad quad;
      std::memcpy(&quad, &corners[triangles[lane][corner]], sizeof quad);
      return quad;
    };
    const auto pair = [&](int lane) {
      return __builtin_shufflevector(load(lane), load(lane + 4), 0, 1, 2, 3, 4, 5, 6, 7);
    };
    const FloatLanes p04 = pair(0), p15 = pair(1), p26 = pair(2), p37 = pair(3);
    // u and v of lanes 0, 1 and 4, 5, then of 2, 3 and 6, 7; and the same of 1/z.
    const FloatLanes uv01 = __builtin_shufflevector(p04, p15, 0, 8, 1, 9, 4, 12, 5, 13);
    const FloatLanes uv23 = __builtin_shufflevector(p26, p37, 0, 8, 1, 9, 4, 12, 5, 13);
    const FloatLanes z01 = __builtin_shufflevector(p04, p15, 2, 10, 3, 11, 6, 14, 7, 15);
    const FloatLanes z23 = __builtin_shufflevector(p26, p37, 2, 10, 3, 11, 6, 14, 7, 15);
    return {.u = __builtin_shufflevector(uv01, uv23, 0, 1, 8, 9, 4, 5, 12, 13),
            .v = __builtin_shufflevector(uv01, uv23, 2, 3, 10, 11, 6, 7, 14, 15),
            .inverse_z = __builtin_shufflevector(z01, z23, 0, 1, 8, 9, 4, 5, 12, 13)};
  }
};

LaneZBuffer::LaneZBuffer(Rasterizer faces, const PinholeCamera& camera, float near_m)
    : faces_(faces), camera_(camera), near_m_(near_m), depth_(camera.width, camera.height) {}

const DepthImage& LaneZBuffer::Render(const std::vector<Vector3f>& vertices_in_camera,
                                      const std::vector<Triangle>& triangles) & {
  Clear(drawn_);
  Project(vertices_in_camera);
  CollectDrawn(triangles);
  drawn_ = Draw();
  Invert(drawn_);
  return depth_;
}

void LaneZBuffer::Project(const std::vector<Vector3f>& vertices_in_camera) {
  corners_.resize(vertices_in_camera.size());
  const auto fx = static_cast<float>(camera_.fx), fy = static_cast<float>(camera_.fy);
  const auto cx = static_cast<float>(camera_.cx), cy = static_cast<float>(camera_.cy);
  for (std::size_t i = 0; i < vertices_in_camera.size(); ++i) {
    const Vector3f& p = vertices_in_camera[i];
    const float reciprocal = 1.0f / p.z();
    const float inverse_z = p.z() > near_m_ ? reciprocal : 0.0f;
    corners_[i] = {fx * p.x() * inverse_z + cx, fy * p.y() * inverse_z + cy, inverse_z, 0.0f};
  }
}

void LaneZBuffer::CollectDrawn(const std::vector<Triangle>& triangles) {
  faces_to_draw_.resize(std::max(faces_to_draw_.size(), triangles.size() + kLanes));
  std::size_t count = 0;
  const auto collect = [&](const Triangle* group) {
    const TriangleLanes lanes(corners_, group);
    const BoxLanes boxes = lanes.Boxes(camera_);
    const FloatLanes farthest = Min(Min(lanes.a.inverse_z, lanes.b.inverse_z), lanes.c.inverse_z);
    const FloatLanes area = lanes.Area();
    const IntLanes is_face = faces_ == Rasterizer::kFrontFaces ? area < 0.0f : area != 0.0f;
    const IntLanes drawn =
        is_face & (boxes.left <= boxes.right) & (boxes.top <= boxes.bottom) & (farthest > 0.0f);
    for (unsigned left = Bits(drawn); left != 0; left &= left - 1) {
      faces_to_draw_[count++] = group[std::countr_zero(left)];
    }
  };
  // Remaining lanes are filled with the last triangle: drawing it twice has no effect.
  std::size_t i = 0;
  for (; i + kLanes <= triangles.size(); i += kLanes) collect(&triangles[i]);
  if (i < triangles.size()) {
    std::array<Triangle, kLanes> rest;
    rest.fill(triangles.back());
    std::copy(triangles.begin() + static_cast<std::ptrdiff_t>(i), triangles.end(), rest.begin());
    collect(rest.data());
  }
  while (count % kLanes != 0) {
    faces_to_draw_[count] = faces_to_draw_[count - 1];
    ++count;
  }
  face_count_ = count;
}

// Returns the box of what was drawn. The buffer holds 1/z meanwhile (larger is nearer, 0 is empty).
LaneZBuffer::Box LaneZBuffer::Draw() {
  Box drawn{camera_.width, camera_.height, -1, -1};
  float* pixels = depth_.pixels().data();
  for (std::size_t i = 0; i < face_count_; i += kLanes) {
    const TriangleLanes lanes(corners_, &faces_to_draw_[i]);
    const auto& [a, b, c] = lanes;
    const BoxLanes boxes = lanes.Boxes(camera_);
    drawn.left = std::min(drawn.left, static_cast<int>(SmallestLane(boxes.left)));
    drawn.top = std::min(drawn.top, static_cast<int>(SmallestLane(boxes.top)));
    drawn.right = std::max(drawn.right, static_cast<int>(-SmallestLane(-boxes.right)));
    drawn.bottom = std::max(drawn.bottom, static_cast<int>(-SmallestLane(-boxes.bottom)));
    // Barycentric coordinates and 1/z are affine in the pixel.
    const FloatLanes inverse_area = 1.0f / lanes.Area();
    const FloatLanes b_du = (c.v - a.v) * inverse_area, b_dv = -(c.u - a.u) * inverse_area;
    const FloatLanes c_du = -(b.v - a.v) * inverse_area, c_dv = (b.u - a.u) * inverse_area;
    // Each lane walks through the pixels of its own box, row by row.
    FloatLanes u = boxes.left, v = boxes.top;
    for (IntLanes walking = v <= boxes.bottom; Bits(walking) != 0; walking = v <= boxes.bottom) {
      const FloatLanes du = u - a.u, dv = v - a.v;
      const FloatLanes weight_b = du * b_du + dv * b_dv;
      const FloatLanes weight_c = du * c_du + dv * c_dv;
      const FloatLanes weight_a = 1.0f - weight_b - weight_c;
      const FloatLanes inverse_z =
          weight_a * a.inverse_z + weight_b * b.inverse_z + weight_c * c.inverse_z;
      const IntLanes pixel = Truncate(v) * camera_.width + Truncate(u);
      const IntLanes inside = walking & (Min(Min(weight_a, weight_b), weight_c) >= 0.0f);
      for (unsigned left = Bits(inside); left != 0; left &= left - 1) {
        const int lane = std::countr_zero(left);
        pixels[pixel[lane]] = std::max(pixels[pixel[lane]], inverse_z[lane]);
      }
      u += 1.0f;
      const IntLanes row_ends = u > boxes.right;
      u = row_ends ? boxes.left : u;
      v = row_ends ? v + 1.0f : v;
    }
  }
  return drawn;
}

void LaneZBuffer::Clear(const Box& box) {
  for (int v = box.top; v <= box.bottom; ++v) {
    std::fill(&depth_(0, v) + box.left, &depth_(0, v) + box.right + 1, 0.0f);
  }
}

void LaneZBuffer::Invert(const Box& box) {
  for (int v = box.top; v <= box.bottom; ++v) {
    float* row = &depth_(0, v);
    for (int u = box.left; u <= box.right; ++u) {
      const float z = 1.0f / row[u];  // infinite where nothing was drawn
      row[u] = z <= std::numeric_limits<float>::max() ? z : 0.0f;
    }
  }
}

}  // namespace vitruvia
