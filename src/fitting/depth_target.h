// A depth frame as the target of a fit. World frame: the camera's.
//
// The frame is seen in cells of some pixels, so that noise and lost pixels at edges matter little.
// A vertex that is visible on the rendered body may lie behind what was measured (something hides
// it: it counts for nothing); in front of it, or where nothing was measured, it contradicts the
// frame.
#pragma once

#include "fitting/fit_target.h"
#include "geometry/front_face_zbuffer.h"
#include "geometry/point_sets.h"
#include "search/kd_tree.h"

namespace vitruvia {

struct DepthTargetSettings {
  int columns = 80;   // cells in a row of the image
  int points = 3000;  // at most, of the frame, that the body looks for
  int seekers = 500;  // of them, that look for the body
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
  // Mean over the measured cells of how far the rendered body is from them along the ray, truncated
  // at far_m. A cell that only body or frame covers counts as far. Much quicker than Measure().
  double ImageDistance(const PosedBody& body, double far_m);
  Vector3d Center() const override { return centroid_; }
  Vector3d VisibleCenter(const PosedBody& body) override;

 private:
  // What the frame says of a vertex that is visible on the body.
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
