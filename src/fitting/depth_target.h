// A depth frame as the target of a fit. The world frame is the camera's frame.
//
// The frame is reduced to cells of several pixels, which reduces the effect of noise and of missing
// pixels at edges. A visible vertex of the rendered body that lies behind the measured surface is
// hidden by something and ignored; a vertex in front of it, or where nothing was measured,
// contradicts the frame.
#pragma once

#include "fitting/fit_target.h"
#include "geometry/front_face_zbuffer.h"
#include "geometry/point_sets.h"
#include "search/kd_tree.h"

namespace vitruvia {

struct DepthTargetSettings {
  int columns = 80;   // number of cells in a row of the image
  int points = 3000;  // maximum number of the frame's points to which the body's vertices are
                      // paired
  int seekers = 500;  // number of these points that are themselves paired to the body
  float max_depth_m = 8.0;
};

class DepthTarget final : public FitTarget {
 public:
  DepthTarget(const DepthImage& depth, const PinholeCamera& camera,
              const DepthTargetSettings& settings);

  bool is_empty() const { return points_.points.empty(); }
  double height_m() const { return double{BoundingBox(points_.points).sizes().y()}; }
  void FindPairs(const PosedBody& body, double cutoff_m, std::vector<FitPair>& pairs) override;
  MutualDistance Measure(const PosedBody& body, const NearFar& limits) override;
  // Mean over the measured cells of the distance to the rendered body along the ray, truncated at
  // far_m. A cell that only the body or only the frame covers counts as far_m. Much faster than
  // Measure().
  double ImageDistance(const PosedBody& body, double far_m);
  Vector3d Center() const override { return centroid_; }
  Vector3d VisibleCenter(const PosedBody& body) override;

 private:
  // Evidence of the frame about a vertex that is visible on the rendered body.
  enum class Evidence { kSurface, kHidden, kContradicted };

  void FindVisible(const PosedBody& body);
  Evidence EvidenceOf(const Vector3f& vertex, double margin_m) const;

  PinholeCamera cell_camera_;
  DepthImage cells_;
  int measured_cells_ = 0;
  OrientedPoints points_, seekers_;
  Vector3d centroid_ = Vector3d::Zero();
  KdTree tree_, body_tree_;
  FrontFaceZBuffer zbuffer_;
  std::vector<int> visible_;
  std::vector<Vector3f> visible_positions_;
  std::vector<KdTree::Neighbor> neighbors_;
};

}  // namespace vitruvia
