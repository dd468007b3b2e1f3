#include "geometry/lane_zbuffer.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "math/lanes.h"

namespace vitruvia {

struct LaneZBuffer::BoxLanes {  // of pixel centres, both ends included
  FloatLanes left, top, right, bottom;

  // The box round these boxes, lane by lane.
  void Include(const BoxLanes& other) {
    left = Min(left, other.left);
    top = Min(top, other.top);
    right = Max(right, other.right);
    bottom = Max(bottom, other.bottom);
  }
};

// The same corner of eight triangles, or eight corners.
struct LaneZBuffer::CornerLanes {
  FloatLanes u, v, inverse_z;

  // One load for each corner, then a transposition in registers: numbers that are set lane by lane
  // go through memory. `corner_of(lane)` is the corner in a lane.
  template <class CornerOf>
  static CornerLanes Load(const CornerOf& corner_of) {
    const auto load = [&](int lane) {
      FloatQuad quad;
      std::memcpy(&quad, &corner_of(lane), sizeof quad);
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

  // The other way round.
  void Store(Corner* corners) const {
    const FloatLanes zero{};
    const FloatLanes uv01 = __builtin_shufflevector(u, v, 0, 8, 1, 9, 4, 12, 5, 13);
    const FloatLanes uv23 = __builtin_shufflevector(u, v, 2, 10, 3, 11, 6, 14, 7, 15);
    const FloatLanes z01 = __builtin_shufflevector(inverse_z, zero, 0, 8, 1, 9, 4, 12, 5, 13);
    const FloatLanes z23 = __builtin_shufflevector(inverse_z, zero, 2, 10, 3, 11, 6, 14, 7, 15);
    const auto store = [&](int lane, const FloatLanes& pair) {
      std::memcpy(&corners[lane], &pair, sizeof(Corner));
      const FloatQuad upper = __builtin_shufflevector(pair, pair, 4, 5, 6, 7);
      std::memcpy(&corners[lane + 4], &upper, sizeof(Corner));
    };
    store(0, __builtin_shufflevector(uv01, z01, 0, 1, 8, 9, 4, 5, 12, 13));
    store(1, __builtin_shufflevector(uv01, z01, 2, 3, 10, 11, 6, 7, 14, 15));
    store(2, __builtin_shufflevector(uv23, z23, 0, 1, 8, 9, 4, 5, 12, 13));
    store(3, __builtin_shufflevector(uv23, z23, 2, 3, 10, 11, 6, 7, 14, 15));
  }
};

// Eight triangles side by side.
struct LaneZBuffer::TriangleLanes {
  CornerLanes a, b, c;

  // `triangle_of(lane)` is the triangle in a lane.
  template <class TriangleOf>
  TriangleLanes(const std::vector<Corner>& corners, const TriangleOf& triangle_of)
      : a(Corners(corners, triangle_of, 0)),
        b(Corners(corners, triangle_of, 1)),
        c(Corners(corners, triangle_of, 2)) {}

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
  template <class TriangleOf>
  static CornerLanes Corners(const std::vector<Corner>& corners, const TriangleOf& triangle_of,
                             int corner) {
    return CornerLanes::Load(
        [&](int lane) -> const Corner& { return corners[triangle_of(lane)[corner]]; });
  }
};

LaneZBuffer::LaneZBuffer(Rasterizer faces, const PinholeCamera& camera, float near_m)
    : faces_(faces),
      camera_(camera),
      near_m_(near_m),
      depth_(camera.width, camera.height),
      faces_to_draw_{{{1.0f}, {2.0f}, {4.0f}, {std::numeric_limits<float>::max()}}} {}

const DepthImage& LaneZBuffer::Render(const std::vector<Vector3f>& vertices_in_camera,
                                      const std::vector<Triangle>& triangles) & {
  Clear(drawn_);
  Project(vertices_in_camera);
  CollectDrawn(triangles);
  drawn_ = Draw(triangles);
  Invert(drawn_);
  return depth_;
}

void LaneZBuffer::Project(const std::vector<Vector3f>& vertices_in_camera) {
  corners_.resize(vertices_in_camera.size());
  const auto fx = static_cast<float>(camera_.fx), fy = static_cast<float>(camera_.fy);
  const auto cx = static_cast<float>(camera_.cx), cy = static_cast<float>(camera_.cy);
  std::size_t i = 0;
  for (; i + kLanes <= vertices_in_camera.size(); i += kLanes) {
    const PointLanes p = LoadPoints(vertices_in_camera[i].data());
    const FloatLanes inverse_z = p.z > near_m_ ? 1.0f / p.z : FloatLanes{};
    const CornerLanes corners{fx * p.x * inverse_z + cx, fy * p.y * inverse_z + cy, inverse_z};
    corners.Store(&corners_[i]);
  }
  for (; i < vertices_in_camera.size(); ++i) {
    const Vector3f& p = vertices_in_camera[i];
    const float inverse_z = p.z() > near_m_ ? 1.0f / p.z() : 0.0f;
    corners_[i] = {fx * p.x() * inverse_z + cx, fy * p.y() * inverse_z + cy, inverse_z, 0.0f};
  }
}

void LaneZBuffer::CollectDrawn(const std::vector<Triangle>& triangles) {
  for (FacesOfSize& list : faces_to_draw_) {
    list.faces.resize(std::max(list.faces.size(), triangles.size() + 2 * kLanes));
    list.count = 0;
  }
  const auto collect = [&](IntLanes faces, const auto& triangle_of) {
    const TriangleLanes lanes(corners_, triangle_of);
    const FloatLanes area = lanes.Area();
    const IntLanes is_face = faces_ == Rasterizer::kFrontFaces ? area < 0.0f : area != 0.0f;
    if (Bits(is_face) == 0) return;
    const BoxLanes boxes = lanes.Boxes(camera_);
    const FloatLanes farthest = Min(Min(lanes.a.inverse_z, lanes.b.inverse_z), lanes.c.inverse_z);
    const FloatLanes width = boxes.right - boxes.left + 1.0f;
    const FloatLanes height = boxes.bottom - boxes.top + 1.0f;
    IntLanes left = is_face & (width > 0.0f) & (height > 0.0f) & (farthest > 0.0f);
    for (FacesOfSize& list : faces_to_draw_) {
      const IntLanes fits = left & (width * height <= list.most_pixels);
      list.count += Compress(faces, fits, &list.faces[list.count]);
      left &= ~fits;
    }
  };
  // The lanes behind the last triangle hold it too: drawing it twice has no effect.
  const int count = static_cast<int>(triangles.size()), whole = count / kLanes * kLanes;
  for (int i = 0; i < whole; i += kLanes) {
    collect(CountFrom(i), [&](int lane) -> const Triangle& { return triangles[i + lane]; });
  }
  if (whole < count) {
    const IntLanes rest = CountFrom(whole), last = IntLanes{} + (count - 1);
    const IntLanes faces = rest < last ? rest : last;
    collect(faces, [&](int lane) -> const Triangle& { return triangles[faces[lane]]; });
  }
}

// Returns the box of what was drawn. The buffer holds 1/z meanwhile (larger is nearer, 0 is empty).
LaneZBuffer::Box LaneZBuffer::Draw(const std::vector<Triangle>& triangles) {
  BoxLanes drawn{.left = FloatLanes{} + static_cast<float>(camera_.width),
                 .top = FloatLanes{} + static_cast<float>(camera_.height),
                 .right = FloatLanes{} - 1.0f,
                 .bottom = FloatLanes{} - 1.0f};
  for (FacesOfSize& list : faces_to_draw_) {
    if (list.count == 0) continue;
    std::fill_n(&list.faces[list.count], kLanes - 1, list.faces[list.count - 1]);
    for (std::size_t i = 0; i < list.count; i += kLanes) {
      const int* faces = &list.faces[i];
      const TriangleLanes lanes(
          corners_, [&](int lane) -> const Triangle& { return triangles[faces[lane]]; });
      const BoxLanes boxes = lanes.Boxes(camera_);
      drawn.Include(boxes);
      DrawEight(lanes, boxes);
    }
  }
  return {.left = static_cast<int>(SmallestLane(drawn.left)),
          .top = static_cast<int>(SmallestLane(drawn.top)),
          .right = static_cast<int>(-SmallestLane(-drawn.right)),
          .bottom = static_cast<int>(-SmallestLane(-drawn.bottom))};
}

void LaneZBuffer::DrawEight(const TriangleLanes& lanes, const BoxLanes& boxes) {
  const auto& [a, b, c] = lanes;
  float* pixels = depth_.pixels().data();
  // Barycentric coordinates and 1/z are affine in the pixel.
  const FloatLanes inverse_area = 1.0f / lanes.Area();
  const FloatLanes b_du = (c.v - a.v) * inverse_area, b_dv = -(c.u - a.u) * inverse_area;
  const FloatLanes c_du = -(b.v - a.v) * inverse_area, c_dv = (b.u - a.u) * inverse_area;
  // Each lane walks through the pixels of its own box, row by row, and stays at the last one.
  FloatLanes u = boxes.left, v = boxes.top;
  for (IntLanes walking = v <= boxes.bottom; Bits(walking) != 0; walking = v <= boxes.bottom) {
    const FloatLanes du = u - a.u, dv = v - a.v;
    const FloatLanes weight_b = du * b_du + dv * b_dv;
    const FloatLanes weight_c = du * c_du + dv * c_dv;
    const FloatLanes weight_a = 1.0f - weight_b - weight_c;
    const FloatLanes inverse_z =
        weight_a * a.inverse_z + weight_b * b.inverse_z + weight_c * c.inverse_z;
    const IntLanes inside = walking & (Min(Min(weight_a, weight_b), weight_c) >= 0.0f);
    const FloatLanes drawn = inside ? inverse_z : FloatLanes{};
    const IntLanes pixel = Truncate(Min(v, boxes.bottom)) * camera_.width + Truncate(u);
    // Without branches, to avoid mispredictions: 0 changes nothing.
    for (int lane = 0; lane < kLanes; ++lane) {
      pixels[pixel[lane]] = std::max(pixels[pixel[lane]], drawn[lane]);
    }
    u += 1.0f;
    const IntLanes row_ends = u > boxes.right;
    u = row_ends ? boxes.left : u;
    v = row_ends ? v + 1.0f : v;
  }
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
