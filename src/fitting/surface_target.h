// A surface as the target of a fit; it may be partial and have several components.
#pragma once

#include "fitting/fit_target.h"
#include "geometry/point_sets.h"
#include "search/kd_tree.h"

namespace vitruvia {

// Whether the surface may lie outside the body.
enum class Clothing { kNone, kLoose };

class SurfaceTarget final : public FitTarget {
 public:
  // `seekers` of the points are paired to the body; the body's vertices are paired to all points.
  SurfaceTarget(OrientedPoints points, int seekers, Clothing clothing);

  void FindPairs(const PosedBody& body, double cutoff_m, std::vector<FitPair>& pairs) override;
  MutualDistance Measure(const PosedBody& body, const NearFar& limits) override;
  Vector3d Center() const override { return centroid_; }
  Vector3d VisibleCenter(const PosedBody& body) override;

 private:
  OrientedPoints points_, seekers_;
  Clothing clothing_;
  Vector3d centroid_;
  KdTree tree_, body_tree_;
  std::vector<KdTree::Neighbor> neighbors_;
};

}  // namespace vitruvia
