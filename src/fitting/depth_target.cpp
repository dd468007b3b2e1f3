#include "fitting/depth_target.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include <Eigen/Eigenvalues>

#include "fitting/distance_sum.h"
#include "geometry/point_cloud.h"
#include "math/lanes.h"

namespace vitruvia {
namespace {

constexpr float kLeastCosine = 0.1f;       // between the normals of a pair
constexpr float kVisibleWithin_m = 0.03f;  // of the rendered depth
constexpr double kLeastMeasured = 0.25;    // share of a cell's pixels

PinholeCamera CellCamera(const PinholeCamera& camera, int columns) {
  const double cell = static_cast<double>(camera.width) / columns;
  PinholeCamera cells = camera;
  cells.width = columns;
  cells.height = static_cast<int>(std::ceil(camera.height / cell));
  cells.fx = camera.fx / cell;
  cells.fy = camera.fy / cell;
  cells.cx = (camera.cx + 0.5) / cell - 0.5;
  cells.cy = (camera.cy + 0.5) / cell - 0.5;
  return cells;
}

// The median of each cell's measured pixels; 0 where too few are.
DepthImage Cells(const DepthImage& depth, const PinholeCamera& cells, float max_depth_m) {
  DepthImage image(cells.width, cells.height);
  const double cell = static_cast<double>(depth.width()) / cells.width;
  std::vector<float> measured;
  for (int row = 0; row < cells.height; ++row) {
    for (int column = 0; column < cells.width; ++column) {
      measured.clear();
      int pixels = 0;
      const int bottom = std::min(depth.height(), static_cast<int>((row + 1) * cell));
      const int right = std::min(depth.width(), static_cast<int>((column + 1) * cell));
      for (int v = static_cast<int>(row * cell); v < bottom; ++v) {
        for (int u = static_cast<int>(column * cell); u < right; ++u) {
          ++pixels;
          const float z = depth(u, v);
          if (z > 0.0f && z <= max_depth_m) measured.push_back(z);
        }
      }
      if (measured.empty() || static_cast<double>(measured.size()) < kLeastMeasured * pixels) {
        continue;
      }
      const auto middle = measured.begin() + static_cast<std::ptrdiff_t>(measured.size() / 2);
      std::nth_element(measured.begin(), middle, measured.end());
      image(column, row) = *middle;
    }
  }
  return image;
}

// The normal, towards the camera, of the plane through the points of a window; zero if there are
// too few.
Vector3f WindowNormal(const DepthImage& depth, const PinholeCamera& camera, int u, int v,
                      int radius_px) {
  constexpr float kSameSurface_m = 0.1f;
  constexpr int kLeastPoints = 6;
  const float z = depth(u, v);
  Vector3f sum = Vector3f::Zero();
  std::vector<Vector3f> window;
  for (int y = v - radius_px; y <= v + radius_px; ++y) {
    for (int x = u - radius_px; x <= u + radius_px; ++x) {
      if (!depth.Contains(x, y) || !(std::abs(depth(x, y) - z) < kSameSurface_m)) continue;
      window.push_back(
          camera.Unproject<float>(static_cast<float>(x), static_cast<float>(y), depth(x, y)));
      sum += window.back();
    }
  }
  if (static_cast<int>(window.size()) < kLeastPoints) return Vector3f::Zero();
  const Vector3f mean = sum / static_cast<float>(window.size());
  Matrix3<float> covariance = Matrix3<float>::Zero();
  for (const Vector3f& p : window) covariance += (p - mean) * (p - mean).transpose();
  Eigen::SelfAdjointEigenSolver<Matrix3<float>> eigen;
  eigen.computeDirect(covariance);
  Vector3f normal = eigen.eigenvectors().col(0);
  return normal.dot(mean) > 0.0f ? Vector3f(-normal) : normal;
}

OrientedPoints PointsOf(const DepthImage& depth, const PinholeCamera& camera, int most,
                        float max_depth_m) {
  PointCloud cloud;
  CloudFromDepth(depth, camera, 1, max_depth_m, cloud);
  const std::size_t all = cloud.points.size();
  const std::size_t count = std::min(all, static_cast<std::size_t>(most));
  constexpr double kWindow_m = 0.035;  // radius
  OrientedPoints points;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = i * all / count;
    const int u = cloud.pixels[at] % depth.width(), v = cloud.pixels[at] / depth.width();
    const int radius =
        std::clamp(static_cast<int>(std::lround(kWindow_m * camera.fx / depth(u, v))), 1, 8);
    const Vector3f normal = WindowNormal(depth, camera, u, v, radius);
    if (normal.isZero()) continue;
    points.points.push_back(cloud.points[at]);
    points.normals.push_back(normal);
  }
  return points;
}

}  // namespace

DepthTarget::DepthTarget(const DepthImage& depth, const PinholeCamera& camera,
                         const DepthTargetSettings& settings)
    : cell_camera_(CellCamera(camera, std::min(settings.columns, camera.width))),
      cells_(Cells(depth, cell_camera_, settings.max_depth_m)),
      points_(PointsOf(depth, camera, settings.points, settings.max_depth_m)),
      seekers_(EvenlyChosen(points_, settings.seekers)),
      centroid_(Centroid(points_.points)),
      zbuffer_(cell_camera_) {
  tree_.Build(points_.points);
  const std::vector<float>& cells = cells_.pixels();
  measured_cells_ =
      static_cast<int>(std::count_if(cells.begin(), cells.end(), [](float z) { return z > 0.0f; }));
}

void DepthTarget::FindVisible(const PosedBody& body) {
  const std::vector<Vector3f>& vertices = body.vertices();
  const DepthImage& rendered = zbuffer_.Render(vertices, body.body().triangles);
  visible_.clear();
  visible_positions_.clear();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const Vector3f& p = vertices[v];
    if (body.normals()[v].dot(p) >= 0.0f) continue;
    const std::optional<Pixel> pixel = cell_camera_.PixelOf(p);
    if (!pixel) continue;
    const float z = rendered(pixel->u, pixel->v);
    // A cell whose centre the body does not cover is on its outline.
    if (z > 0.0f && p.z() > z + kVisibleWithin_m) continue;
    visible_.push_back(static_cast<int>(v));
    visible_positions_.push_back(p);
  }
}

DepthTarget::Evidence DepthTarget::EvidenceOf(const Vector3f& vertex, double margin_m) const {
  const std::optional<Pixel> cell = cell_camera_.PixelOf(vertex);
  const float measured = cell ? cells_(cell->u, cell->v) : 0.0f;
  if (measured == 0.0f || vertex.z() < measured - margin_m) return Evidence::kContradicted;
  return vertex.z() > measured + margin_m ? Evidence::kHidden : Evidence::kSurface;
}

void DepthTarget::FindPairs(const PosedBody& body, double cutoff_m, std::vector<FitPair>& pairs) {
  const auto cutoff = static_cast<float>(cutoff_m);
  pairs.clear();
  FindVisible(body);
  tree_.FindNearest(visible_positions_, cutoff, neighbors_);
  for (std::size_t i = 0; i < visible_.size(); ++i) {
    if (neighbors_[i].index < 0) continue;
    const auto s = static_cast<std::size_t>(neighbors_[i].index);
    const Vector3f& p = visible_positions_[i];
    const Evidence evidence = EvidenceOf(p, cutoff_m);
    if (evidence == Evidence::kHidden) continue;
    const Vector3f apart = p - points_.points[s];
    const float area = body.AreaShare(visible_[i]);
    if (evidence == Evidence::kContradicted) {
      if (apart.norm() > 0.0f)
        pairs.push_back({visible_[i], points_.points[s], apart.normalized(), area});
    } else if (points_.normals[s].dot(body.normals()[visible_[i]]) > kLeastCosine) {
      pairs.push_back({visible_[i], points_.points[s], points_.normals[s], area});
    }
  }
  body_tree_.Build(visible_positions_);
  body_tree_.FindNearest(seekers_.points, cutoff, neighbors_);
  for (std::size_t q = 0; q < seekers_.points.size(); ++q) {
    if (neighbors_[q].index < 0) continue;
    const int v = visible_[neighbors_[q].index];
    if (seekers_.normals[q].dot(body.normals()[v]) < kLeastCosine) continue;
    pairs.push_back({v, seekers_.points[q], body.normals()[v]});
  }
}

MutualDistance DepthTarget::Measure(const PosedBody& body, const NearFar& limits) {
  const auto far_m = static_cast<float>(limits.far_m);
  FindVisible(body);
  DistanceSum from_body, from_target;
  tree_.FindNearest(visible_positions_, far_m, neighbors_);
  for (std::size_t i = 0; i < visible_.size(); ++i) {
    const Vector3f& p = visible_positions_[i];
    const Evidence evidence = EvidenceOf(p, limits.near_m);
    if (evidence == Evidence::kHidden) continue;
    const float area = body.AreaShare(visible_[i]);
    if (neighbors_[i].index < 0) {
      from_body.Add(limits.far_m, area, limits);
      continue;
    }
    const auto s = static_cast<std::size_t>(neighbors_[i].index);
    const Vector3f apart = p - points_.points[s];
    from_body.Add(evidence == Evidence::kSurface
                      ? SurfaceDistance(apart, points_.normals[s], body.mean_edge_m())
                      : double{apart.norm()},
                  area, limits);
  }
  body_tree_.Build(visible_positions_);
  body_tree_.FindNearest(seekers_.points, far_m, neighbors_);
  for (std::size_t q = 0; q < seekers_.points.size(); ++q) {
    if (neighbors_[q].index < 0) {
      from_target.Add(limits.far_m, 1.0, limits);
      continue;
    }
    const auto v = static_cast<std::size_t>(visible_[neighbors_[q].index]);
    from_target.Add(SurfaceDistance(seekers_.points[q] - body.vertices()[v], body.normals()[v],
                                    body.mean_edge_m()),
                    1.0, limits);
  }
  return {from_target.MeanOr(limits.far_m), from_body.MeanOr(limits.far_m), from_target.share(),
          from_body.share()};
}

double DepthTarget::ImageDistance(const PosedBody& body, double far_m) {
  const std::vector<float>& rendered =
      zbuffer_.Render(body.vertices(), body.body().triangles).pixels();
  const std::vector<float>& measured = cells_.pixels();
  const auto far = static_cast<float>(far_m);
  constexpr auto kSums = static_cast<std::size_t>(kLanes);  // side by side
  std::array<float, kSums> sums{};
  // An empty cell has depth 0: it is far from a covered one, and equal to another empty one.
  const auto add = [&](std::size_t i, std::size_t lane) {
    sums[lane] += std::min(std::abs(rendered[i] - measured[i]), far);
  };
  std::size_t i = 0;
  for (; i + kSums <= measured.size(); i += kSums) {
    for (std::size_t lane = 0; lane < kSums; ++lane) add(i + lane, lane);
  }
  for (; i < measured.size(); ++i) add(i, 0);
  return std::accumulate(sums.begin(), sums.end(), 0.0) / std::max(1, measured_cells_);
}

Vector3d DepthTarget::VisibleCenter(const PosedBody& body) {
  FindVisible(body);
  return visible_positions_.empty() ? body.joints()[0] : Centroid(visible_positions_);
}

}  // namespace vitruvia
