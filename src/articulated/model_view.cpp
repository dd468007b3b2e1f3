#include "articulated/model_view.h"

#include "geometry/point_sets.h"
#include "tracking/visibility.h"

namespace vitruvia::articulated {

ModelView::ModelView(const ShapedBody& body, const PinholeCamera& camera)
    : body_(body), camera_(camera), rasterizer_(MakeRasterizer(Rasterizer::kFrontFaces, camera)) {}

void ModelView::Look(const BoneTransforms& camera_from_rest) {
  constexpr float kVisibleWithin_m = 0.01f;
  SkinLinear(body_.mean, body_.weights, camera_from_rest, vertices_);
  depth_ = &rasterizer_->Render(vertices_, body_.triangles);
  FindVisibleVertices(vertices_, *depth_, camera_, kVisibleWithin_m, visible_);
}

Agreement ModelView::Compare(const DepthImage& captured, const PointCloud& cloud, double near_m) {
  constexpr int kEdge_px = 1;
  constexpr float kSmooth_m = 0.02f;
  const NearnessSettings nearness{static_cast<float>(near_m), kEdge_px, kSmooth_m,
                                  BehindSurface::kHidden};
  ClassifyVertices(vertices_, visible_, captured, camera_, nearness, classes_);
  FindUnexplainedPoints(cloud, *depth_, nearness, unexplained_);
  return MeasureAgreement(cloud.points.size(), unexplained_.size(), visible_.size(), classes_);
}

Vector3d ModelView::VisibleCentroid() const {
  if (visible_.empty()) return Centroid(vertices_);
  Vector3d sum = Vector3d::Zero();
  for (const int v : visible_) sum += vertices_[static_cast<std::size_t>(v)].cast<double>();
  return sum / static_cast<double>(visible_.size());
}

}  // namespace vitruvia::articulated
