#include "tracking/classification.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "math/lanes.h"

namespace vitruvia {

namespace {

bool IsNear(float there, float z, const NearnessSettings& nearness) {
  return there > 0.0f && std::abs(there - z) < nearness.depth_m;
}

// Whether some pixel within edge_px of `at` holds a depth near z.
bool IsExplained(const DepthImage& depth, Pixel at, float z, const NearnessSettings& nearness) {
  for (int y = at.v - nearness.edge_px; y <= at.v + nearness.edge_px; ++y) {
    for (int x = at.u - nearness.edge_px; x <= at.u + nearness.edge_px; ++x) {
      if (!depth.Contains(x, y)) continue;
      if (IsNear(depth(x, y), z, nearness)) return true;
    }
  }
  return false;
}

}  // namespace

void ClassifyVertices(const std::vector<Vector3f>& vertices, const std::vector<int>& visible,
                      const DepthImage& captured, const PinholeCamera& camera,
                      const NearnessSettings& nearness, VertexClasses& classes) {
  const auto fx = static_cast<float>(camera.fx), fy = static_cast<float>(camera.fy);
  const auto cx = static_cast<float>(camera.cx), cy = static_cast<float>(camera.cy);
  classes.near_surface.resize(visible.size() + kLanes);  // Compress writes further ones behind
  classes.observed_depth.resize(visible.size() + kLanes);
  classes.elsewhere.clear();
  std::size_t near_count = 0;
  const auto classify = [&](const IntLanes& indices, const IntLanes& is_vertex) {
    const PointLanes p = GatherPoints(vertices.front().data(), indices);
    const FloatLanes inverse_z = 1.0f / p.z;
    const FloatLanes u = fx * p.x * inverse_z + cx, v = fy * p.y * inverse_z + cy;
    const FloatLanes z = SampleDepth(captured, u, v, nearness.smooth_m);
    const IntLanes is_near = is_vertex & (z > 0.0f) & (Abs(p.z - z) < nearness.depth_m);
    Compress(z, is_near, &classes.observed_depth[near_count]);
    near_count += Compress(indices, is_near, &classes.near_surface[near_count]);
    IntLanes is_open = is_vertex & ~is_near;
    if (nearness.behind == BehindSurface::kHidden) is_open &= ~((z > 0.0f) & (p.z > z));
    for (unsigned left = Bits(is_open); left != 0; left &= left - 1) {
      const int lane = std::countr_zero(left);
      const auto at = camera.PixelAt<float>({u[lane], v[lane]});
      if (!at || !IsExplained(captured, *at, p.z[lane], nearness)) {
        classes.elsewhere.push_back(indices[lane]);
      }
    }
  };
  std::size_t i = 0;
  for (; i + kLanes <= visible.size(); i += kLanes) {
    classify(LoadLanes<IntLanes>(visible, static_cast<int>(i)), ~IntLanes{});
  }
  if (i < visible.size()) {
    IntLanes rest{};
    for (std::size_t lane = 0; i + lane < visible.size(); ++lane) rest[lane] = visible[i + lane];
    classify(rest, CountFrom(static_cast<int>(i)) < static_cast<int>(visible.size()));
  }
  classes.near_surface.resize(near_count);
  classes.observed_depth.resize(near_count);
  classes.weight.assign(near_count, 1.0f);
}

void AverageObservedDepth(const std::vector<Vector3f>& vertices, const DepthImage& captured,
                          const DepthImage& rendered, const PinholeCamera& camera, int window_px,
                          float nearness_m, VertexClasses& classes) {
  for (std::size_t k = 0; k < classes.near_surface.size(); ++k) {
    const Vector3f& vertex = vertices[classes.near_surface[k]];
    const auto at = camera.PixelOf(vertex);
    if (!at) continue;
    float sum_m = 0.0f;
    int count = 0;
    for (int v = std::max(at->v - window_px, 0);
         v <= std::min(at->v + window_px, captured.height() - 1); ++v) {
      for (int u = std::max(at->u - window_px, 0);
           u <= std::min(at->u + window_px, captured.width() - 1); ++u) {
        if (!(captured(u, v) > 0.0f) || !(rendered(u, v) > 0.0f)) continue;
        const float beyond_m = captured(u, v) - rendered(u, v);
        if (std::abs(beyond_m) >= nearness_m) continue;
        sum_m += beyond_m;
        ++count;
      }
    }
    if (count > 0) classes.observed_depth[k] = vertex.z() + sum_m / static_cast<float>(count);
  }
}

PixelSharing::PixelSharing(const PinholeCamera& camera)
    : camera_(camera), readers_(static_cast<std::size_t>(camera.width) * camera.height + 1, 0) {}

void PixelSharing::Weigh(const std::vector<Vector3f>& vertices, float extent,
                         VertexClasses& classes) {
  const int outside = static_cast<int>(readers_.size()) - 1;
  pixels_.clear();
  for (const int i : classes.near_surface) {
    const auto at = camera_.PixelOf(vertices[i]);
    pixels_.push_back(at ? at->v * camera_.width + at->u : outside);
    ++readers_[pixels_.back()];
  }
  for (std::size_t k = 0; k < pixels_.size(); ++k)
    classes.weight[k] = 1.0f - extent + extent / static_cast<float>(readers_[pixels_[k]]);
  for (const int pixel : pixels_) readers_[pixel] = 0;
}

void FindUnexplainedPoints(const PointCloud& cloud, const DepthImage& rendered,
                           const NearnessSettings& nearness, std::vector<int>& unexplained) {
  unexplained.clear();
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    // Most points' own pixel explains them.
    if (IsNear(rendered.pixels()[cloud.pixels[i]], cloud.points[i].z(), nearness)) continue;
    const int u = cloud.pixels[i] % rendered.width(), v = cloud.pixels[i] / rendered.width();
    if (!IsExplained(rendered, {u, v}, cloud.points[i].z(), nearness))
      unexplained.push_back(static_cast<int>(i));
  }
}

void PairFinder::FindNearest(const std::vector<Vector3f>& points, const std::vector<int>& queries,
                             const NearestNeighbors& near, float cutoff_m) {
  positions_.clear();
  for (const int i : queries) positions_.push_back(points[i]);
  near.FindNearest(positions_, cutoff_m, neighbors_);
}

void PairFinder::VerticesToPoints(const std::vector<Vector3f>& vertices,
                                  const std::vector<int>& queries, const PointCloud& cloud,
                                  const NearestNeighbors& near_cloud, float cutoff_m,
                                  std::vector<Pair>& pairs) {
  FindNearest(vertices, queries, near_cloud, cutoff_m);
  for (std::size_t k = 0; k < queries.size(); ++k) {
    if (neighbors_[k].index >= 0) pairs.push_back({queries[k], cloud.points[neighbors_[k].index]});
  }
}

void PairFinder::DropNear(const PointCloud& cloud, const NearestNeighbors& near, float distance_m,
                          std::vector<int>& queries) {
  FindNearest(cloud.points, queries, near, distance_m);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < queries.size(); ++k) {
    if (neighbors_[k].index < 0) queries[kept++] = queries[k];
  }
  queries.resize(kept);
}

}  // namespace vitruvia
