#include "methods/scape_regression/pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/half_edges.h"
#include "geometry/point_cloud.h"
#include "tracking/visibility.h"

namespace vitruvia::scape_regression {
namespace {

constexpr float kSmooth_m = 0.02f;  // depths are interpolated between neighbours within that
constexpr double kHidden_m = 0.03;  // a rim vertex that far behind the model's depth is hidden

bool IsMeasured(const DepthImage& depth, int u, int v, double max_depth_m) {
  const float z = depth(u, v);
  return z > 0.0f && z <= static_cast<float>(max_depth_m);
}

// Two vertices and two triangles for each edge of a closed mesh.
std::vector<std::array<int, 4>> EdgesOf(const std::vector<Triangle>& triangles,
                                        std::size_t vertex_count) {
  const HalfEdges half_edges = FindHalfEdges(triangles, vertex_count);
  std::vector<std::array<int, 4>> edges;
  for (int h = 0; h < static_cast<int>(half_edges.twin.size()); ++h) {
    const int twin = half_edges.twin[h];
    if (twin <= h) continue;
    const Triangle& t = triangles[h / 3];
    edges.push_back({t[h % 3], t[(h % 3 + 1) % 3], h / 3, twin / 3});
  }
  return edges;
}

}  // namespace

double Residual(const DepthPair& pair, const Vector3d& vertex) {
  return pair.along.dot(vertex - pair.target);
}

double Residual(const ContourPair& pair, const PinholeCamera& camera, const Vector3d& vertex) {
  return pair.metres_per_pixel * pair.normal.dot(camera.Project(vertex) - pair.pixel);
}

const Vector3d& Gradient(const DepthPair& pair) { return pair.along; }

Vector3d Gradient(const ContourPair& pair, const PinholeCamera& camera, const Vector3d& vertex) {
  const double z = vertex.z();
  const double u = pair.metres_per_pixel * pair.normal.x() * camera.fx / z;
  const double v = pair.metres_per_pixel * pair.normal.y() * camera.fy / z;
  return {u, v, -(u * vertex.x() + v * vertex.y()) / z};
}

std::vector<Eigen::Vector2d> ObservedContour(const DepthImage& depth, double max_depth_m) {
  constexpr std::array<std::array<int, 2>, 4> kNeighbours{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  std::vector<Eigen::Vector2d> contour;
  for (int v = 1; v + 1 < depth.height(); ++v) {
    for (int u = 1; u + 1 < depth.width(); ++u) {
      if (!IsMeasured(depth, u, v, max_depth_m)) continue;
      for (const auto& [du, dv] : kNeighbours) {
        if (!IsMeasured(depth, u + du, v + dv, max_depth_m))
          contour.emplace_back(u + 0.5 * du, v + 0.5 * dv);
      }
    }
  }
  return contour;
}

PairFinder::PairFinder(const std::vector<Triangle>& triangles, std::size_t vertex_count,
                       const PinholeCamera& camera, const Settings& settings)
    : triangles_(triangles),
      camera_(camera),
      settings_(settings),
      rasterizer_(MakeRasterizer(Rasterizer::kFrontFaces, camera)),
      edges_(EdgesOf(triangles, vertex_count)) {}

const Pairs& PairFinder::Find(const std::vector<Vector3f>& vertices, const DepthImage& depth,
                              const std::vector<Eigen::Vector2d>& observed_contour) {
  const DepthImage& rendered = rasterizer_->Render(vertices, triangles_);
  ComputeVertexNormals(vertices, triangles_, normals_);
  FindVisibleVertices(vertices, rendered, camera_, static_cast<float>(settings_.visible_within_m),
                      visible_);
  pairs_.visible = visible_.size();
  FindDepthPairs(vertices, depth);
  FindModelContour(vertices, rendered);
  PairContours(observed_contour);
  return pairs_;
}

void PairFinder::FindDepthPairs(const std::vector<Vector3f>& vertices, const DepthImage& depth) {
  pairs_.depth.clear();
  for (const int v : visible_) {
    const Vector3d vertex = vertices[v].cast<double>();
    const Vector3d ray = vertex / vertex.z();
    const Vector3d normal = normals_[v].cast<double>();
    const double facing = -normal.dot(ray);
    if (facing < settings_.depth.facing_cosine * ray.norm()) continue;
    const Eigen::Vector2d uv = camera_.Project(vertex);
    const double z =
        SampleDepth(depth, static_cast<float>(uv.x()), static_cast<float>(uv.y()), kSmooth_m);
    if (!(z > 0.0) || z > settings_.max_depth_m) continue;
    pairs_.depth.push_back({v, z * ray, -normal / facing});
  }
}

// Vertices of edges where the surface turns away from the camera and beyond which the model leaves
// the image empty.
void PairFinder::FindModelContour(const std::vector<Vector3f>& vertices,
                                  const DepthImage& rendered) {
  faces_camera_.resize(triangles_.size());
  for (std::size_t k = 0; k < triangles_.size(); ++k) {
    const Triangle& t = triangles_[k];
    const Vector3f& a = vertices[t[0]];
    faces_camera_[k] = (vertices[t[1]] - a).cross(vertices[t[2]] - a).dot(a) < 0.0f ? 1 : 0;
  }
  on_rim_.assign(vertices.size(), 0);
  for (const auto& [a, b, first, second] : edges_) {
    if (faces_camera_[first] != faces_camera_[second]) on_rim_[a] = on_rim_[b] = 1;
  }
  contour_.clear();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (on_rim_[v] == 0) continue;
    const Vector3d vertex = vertices[v].cast<double>();
    if (!camera_.InView(vertex)) continue;
    const Eigen::Vector2d pixel = camera_.Project(vertex);
    if (!IsOutside(pixel, vertex.z(), rendered)) continue;
    const Eigen::Vector2d normal = normals_[v].head<2>().cast<double>();
    if (!(normal.norm() > 0.3)) continue;
    contour_.push_back({static_cast<int>(v), pixel, normal.normalized(), vertex.z() / camera_.fx});
  }
}

bool PairFinder::IsOutside(const Eigen::Vector2d& pixel, double z,
                           const DepthImage& rendered) const {
  const int u = static_cast<int>(std::lround(pixel.x())),
            v = static_cast<int>(std::lround(pixel.y()));
  const int margin = settings_.contour.margin_px;
  bool has_empty = false;
  for (int dv = -margin; dv <= margin; ++dv) {
    for (int du = -margin; du <= margin; ++du) {
      if (!rendered.Contains(u + du, v + dv)) continue;
      const float drawn = rendered(u + du, v + dv);
      has_empty = has_empty || drawn == 0.0f;
      if (du == 0 && dv == 0 && drawn > 0.0f && drawn < static_cast<float>(z - kHidden_m))
        return false;
    }
  }
  return has_empty;
}

void PairFinder::PairContours(const std::vector<Eigen::Vector2d>& observed) {
  pairs_.model_to_observed.clear();
  pairs_.observed_to_model.clear();
  const double cutoff = settings_.contour.cutoff_m;
  for (const ContourVertex& c : contour_) {
    double nearest = std::numeric_limits<double>::infinity();
    Eigen::Vector2d found = c.pixel;
    for (const Eigen::Vector2d& pixel : observed) {
      const double distance = (pixel - c.pixel).squaredNorm();
      if (distance < nearest) {
        nearest = distance;
        found = pixel;
      }
    }
    if (std::sqrt(nearest) * c.metres_per_pixel > cutoff) continue;
    pairs_.model_to_observed.push_back({c.vertex, found, c.normal, c.metres_per_pixel});
  }
  for (std::size_t i = 0; i < observed.size(); i += settings_.contour.stride) {
    const Eigen::Vector2d& pixel = observed[i];
    double nearest = std::numeric_limits<double>::infinity();
    const ContourVertex* found = nullptr;
    for (const ContourVertex& c : contour_) {
      const double distance = (pixel - c.pixel).squaredNorm();
      if (distance < nearest) {
        nearest = distance;
        found = &c;
      }
    }
    if (found == nullptr || std::sqrt(nearest) * found->metres_per_pixel > cutoff) continue;
    pairs_.observed_to_model.push_back(
        {found->vertex, pixel, found->normal, found->metres_per_pixel});
  }
}

}  // namespace vitruvia::scape_regression
