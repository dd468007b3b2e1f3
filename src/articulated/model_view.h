// What the camera sees of the subject's surface in a pose.
#pragma once

#include <memory>

#include "fitting/shaped_body.h"
#include "geometry/mesh_rasterizer.h"
#include "tracking/agreement.h"

namespace vitruvia::articulated {

class ModelView {
 public:
  // The body, whose surface is closed, must outlive the view.
  ModelView(const ShapedBody& body, const PinholeCamera& camera);

  void Look(const BoneTransforms& camera_from_rest);
  const std::vector<Vector3f>& vertices() const { return vertices_; }  // camera frame
  const DepthImage& depth() const { return *depth_; }                  // rendered
  const std::vector<int>& visible() const { return visible_; }         // vertices, ascending

  // Agreement of a frame with the pose of the last Look().
  Agreement Compare(const DepthImage& captured, const PointCloud& cloud, double near_m);
  // The mean of the visible vertices, or of all vertices if none is visible.
  Vector3d VisibleCentroid() const;

 private:
  const ShapedBody& body_;
  PinholeCamera camera_;
  std::unique_ptr<MeshRasterizer> rasterizer_;
  std::vector<Vector3f> vertices_;
  const DepthImage* depth_ = nullptr;
  std::vector<int> visible_;
  VertexClasses classes_;
  std::vector<int> unexplained_;
};

}  // namespace vitruvia::articulated
