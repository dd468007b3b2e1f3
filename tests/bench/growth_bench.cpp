// How the cost of the kernels inside a frame grows with vertices, points and pixels, and with what
// lies out of view: a time at each size, and the exponent of a power law through them.
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "bench/bench.h"
#include "body/skinning.h"
#include "geometry/mesh_rasterizer.h"
#include "geometry/point_cloud.h"
#include "math/rigid.h"
#include "search/nearest_neighbors.h"
#include "synth/bodies/body_source.h"

namespace vitruvia::bench {
namespace {

constexpr int kGrowthRepeats = 31;
constexpr double kDistance_m = 2.8;
constexpr float kCutoff_m = 0.08f;
constexpr int kWindow_px = 8;

struct Sample {
  double size, ms;
};

// The slope of the regression line of log time on log size.
double Exponent(const std::vector<Sample>& samples) {
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const Sample& sample : samples) {
    const double u = std::log(sample.size), v = std::log(sample.ms);
    x += u, y += v, xx += u * u, xy += u * v;
  }
  const auto n = static_cast<double>(samples.size());
  return (n * xy - x * y) / (n * xx - x * x);
}

void AddRows(const std::string& kernel, const std::string& with, const std::vector<Sample>& samples,
             std::vector<Row>& rows) {
  for (const Sample& sample : samples) {
    rows.push_back({fmt::format("{}_ms_{}_{:.0f}", kernel, with, sample.size), sample.ms, "ms"});
  }
  rows.push_back({kernel + "_exponent_of_" + with, Exponent(samples), "1"});
}

// The mannequin of so many Catmull–Clark steps: 6,370 vertices after two, four times as many with
// each further one.
BodyModel Mannequin(int subdivisions) {
  return Refine(MakeControlBody({}), {.subdivisions = subdivisions});
}

// In front of the camera and facing it, moved to the side.
std::vector<Vector3f> InView(const std::vector<Vector3f>& subject, double aside_m = 0.0) {
  std::vector<Vector3f> points;
  for (const Vector3f& p : subject) {
    points.push_back({p.x() + static_cast<float>(aside_m), 0.95f - p.y(),
                      static_cast<float>(kDistance_m) - p.z()});
  }
  return points;
}

PinholeCamera CameraOfWidth(int width) {
  PinholeCamera camera;
  const double scale = static_cast<double>(width) / camera.width;
  camera.height = static_cast<int>(camera.height * scale);
  camera.width = width;
  camera.fx *= scale;
  camera.fy *= scale;
  camera.cx = 0.5 * (camera.width - 1);
  camera.cy = 0.5 * (camera.height - 1);
  return camera;
}

double RenderMs(Rasterizer kind, const PinholeCamera& camera, const std::vector<Vector3f>& vertices,
                const std::vector<Triangle>& triangles) {
  const auto rasterizer = MakeRasterizer(kind, camera);
  rasterizer->Render(vertices, triangles);
  return MedianMs(kGrowthRepeats, [&] { rasterizer->Render(vertices, triangles); });
}

double SearchMs(Association association, const PinholeCamera& camera,
                const std::vector<Vector3f>& points, const std::vector<Vector3f>& queries) {
  const auto search = MakeNearestNeighbors(association, camera, kWindow_px);
  std::vector<KdTree::Neighbor> neighbors;
  return MedianMs(kGrowthRepeats, [&] {
    search->Build(points);
    search->FindNearest(queries, kCutoff_m, neighbors);
  });
}

void Rendering(const std::vector<BodyModel>& bodies, std::vector<Row>& rows) {
  constexpr std::pair<Rasterizer, const char*> kKinds[] = {
      {Rasterizer::kFrontFaces, "render_front_faces"},
      {Rasterizer::kAllTriangles, "render_all_triangles"}};
  for (const auto& [kind, name] : kKinds) {
    std::vector<Sample> by_vertices, by_pixels;
    for (const BodyModel& body : bodies) {
      by_vertices.push_back({static_cast<double>(body.rest.vertices.size()),
                             RenderMs(kind, {}, InView(body.rest.vertices), body.rest.triangles)});
    }
    const TriangleMesh& mesh = bodies.front().rest;
    for (const int width : {320, 640, 1280}) {
      const PinholeCamera camera = CameraOfWidth(width);
      by_pixels.push_back({static_cast<double>(camera.width) * camera.height,
                           RenderMs(kind, camera, InView(mesh.vertices), mesh.triangles)});
    }
    AddRows(name, "vertices", by_vertices, rows);
    AddRows(name, "pixels", by_pixels, rows);
    constexpr double kOutOfView_m = 5.0;
    rows.push_back({std::string(name) + "_ms_out_of_view",
                    RenderMs(kind, {}, InView(mesh.vertices, kOutOfView_m), mesh.triangles), "ms"});
  }
}

void Searching(const BodyModel& body, std::vector<Row>& rows) {
  constexpr std::pair<Association, const char*> kKinds[] = {
      {Association::kKdTree, "search_kd_tree"},
      {Association::kWindow, "search_window"},
      {Association::kExhaustive, "search_exhaustive"}};
  const std::vector<Vector3f> vertices = InView(body.rest.vertices);
  for (const auto& [association, name] : kKinds) {
    std::vector<Sample> samples;
    for (const int width : {160, 320, 640}) {
      const PinholeCamera camera = CameraOfWidth(width);
      PointCloud cloud;
      CloudFromDepth(
          MakeRasterizer(Rasterizer::kFrontFaces, camera)->Render(vertices, body.rest.triangles),
          camera, 1, std::numeric_limits<float>::infinity(), cloud);
      samples.push_back({static_cast<double>(cloud.points.size()),
                         SearchMs(association, camera, cloud.points, vertices)});
    }
    AddRows(name, "points", samples, rows);
  }
}

void Skinning(const std::vector<BodyModel>& bodies, std::vector<Row>& rows) {
  constexpr std::pair<decltype(&SkinLinear), const char*> kKinds[] = {
      {SkinLinear, "skin_linear"}, {SkinDualQuaternion, "skin_dual_quaternion"}};
  for (const auto& [skin, name] : kKinds) {
    std::vector<Sample> samples;
    for (const BodyModel& body : bodies) {
      const BoneTransforms still(kBoneCount);
      std::vector<Vector3f> posed;
      samples.push_back({static_cast<double>(body.rest.vertices.size()),
                         MedianMs(kGrowthRepeats, [&, skin = skin] {
                           skin(body.rest.vertices, body.weights, still, posed);
                         })});
    }
    AddRows(name, "vertices", samples, rows);
  }
}

}  // namespace

std::vector<Row> Growth() {
  const std::vector<BodyModel> bodies = {Mannequin(2), Mannequin(3), Mannequin(4)};
  std::vector<Row> rows;
  Rendering(bodies, rows);
  Searching(bodies.front(), rows);
  Skinning(bodies, rows);
  return rows;
}

}  // namespace vitruvia::bench
