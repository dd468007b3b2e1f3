// A surface as the target of a fit: whole or in part, of one piece or several.
#pragma once

#include "fitting/fit_target.h"
#include "geometry/point_sets.h"
#include "search/kd_tree.h"

namespace vitruvia {

// How far outside of a body its surface may lie.
enum class Clothing { kNone, kLoose };

class SurfaceTarget final : public FitTarget {
 public:
  // `seekers` of the points look for the body; the body looks for all of them.
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
