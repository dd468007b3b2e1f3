// Correspondences of model and frame: depths of visible vertices, and points of both contours.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "geometry/camera.h"
#include "geometry/image.h"
#include "geometry/mesh.h"
#include "geometry/mesh_rasterizer.h"
#include "methods/scape_regression/settings.h"

namespace vitruvia::scape_regression {

// The difference in depth along a ray: a · (v − target), metres, with a = n / (n · ray), ray scaled
// to unit z, so that the surface may slide over it.
struct DepthPair {
  int vertex;
  Vector3d target;  // the observed point on the vertex's ray, camera frame
  Vector3d along;   // a
};

// The distance between contours across the model's, in metres at the vertex's depth: (z / f) n ·
// (π(v) − pixel), with z and n fixed when the pair is found.
struct ContourPair {
  int vertex;
  Eigen::Vector2d pixel;   // of the observed contour
  Eigen::Vector2d normal;  // of the model's contour in the image, unit length
  double metres_per_pixel;
};

struct Pairs {
  std::vector<DepthPair> depth;
  std::vector<ContourPair> model_to_observed, observed_to_model;
  std::size_t visible = 0;  // vertices
};

double Residual(const DepthPair& pair, const Vector3d& vertex);
double Residual(const ContourPair& pair, const PinholeCamera& camera, const Vector3d& vertex);
// Derivatives of the residuals with respect to the vertex.
const Vector3d& Gradient(const DepthPair& pair);
Vector3d Gradient(const ContourPair& pair, const PinholeCamera& camera, const Vector3d& vertex);

// Points halfway between neighbouring pixels with and without a measurement, inside the image.
std::vector<Eigen::Vector2d> ObservedContour(const DepthImage& depth, double max_depth_m);

class PairFinder {
 public:
  PairFinder(const std::vector<Triangle>& triangles, std::size_t vertex_count,
             const PinholeCamera& camera, const Settings& settings);

  const Pairs& Find(const std::vector<Vector3f>& vertices, const DepthImage& depth,
                    const std::vector<Eigen::Vector2d>& observed_contour);

 private:
  struct ContourVertex {
    int vertex;
    Eigen::Vector2d pixel, normal;
    double metres_per_pixel;
  };

  void FindDepthPairs(const std::vector<Vector3f>& vertices, const DepthImage& depth);
  void FindModelContour(const std::vector<Vector3f>& vertices, const DepthImage& rendered);
  bool IsOutside(const Eigen::Vector2d& pixel, double z, const DepthImage& rendered) const;
  void PairContours(const std::vector<Eigen::Vector2d>& observed);

  const std::vector<Triangle>& triangles_;
  PinholeCamera camera_;
  Settings settings_;
  std::unique_ptr<MeshRasterizer> rasterizer_;
  std::vector<std::array<int, 4>> edges_;  // two vertices, two triangles

  // Kept between calls to avoid allocation.
  std::vector<Vector3f> normals_;
  std::vector<int> visible_;
  std::vector<char> faces_camera_, on_rim_;
  std::vector<ContourVertex> contour_;
  Pairs pairs_;
};

}  // namespace vitruvia::scape_regression
