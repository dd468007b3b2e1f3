// The target to which a body is fitted, a surface or a depth frame: it finds correspondences and
// measures distances.
#pragma once

#include <vector>

#include "fitting/shaped_body.h"

namespace vitruvia {

// A correspondence between a vertex of the body and a target point. The residual is the distance
// along the normal and a share of the distance in space.
struct FitPair {
  int vertex = -1;
  Vector3f target, normal;  // world frame; the normal of unit length
  float weight = 1.0f;
};

// Distances between two surfaces in both directions. A surface is sampled by points; the distance
// of a point from it is the larger of the distance along the normal and the distance in space minus
// the points' spacing. Distances are truncated at `far_m`. Parts that cannot be observed (occluded
// or out of the image) do not count.
struct MutualDistance {
  double target_to_body_m = 0.0;  // mean over the target's points
  double body_to_target_m = 0.0;  // mean over the body's vertices that can be judged
  double target_explained = 0.0;  // share of the target's points within `near_m`
  double body_explained = 0.0;    // share of the judged vertices within `near_m`

  double mean_m() const { return 0.5 * (target_to_body_m + body_to_target_m); }
};

struct NearFar {
  double near_m = 0.04, far_m = 0.15;
};

class FitTarget {
 public:
  virtual ~FitTarget() = default;
  // Replaces `pairs`. No pair is farther apart than cutoff_m.
  virtual void FindPairs(const PosedBody& body, double cutoff_m, std::vector<FitPair>& pairs) = 0;
  virtual MutualDistance Measure(const PosedBody& body, const NearFar& limits) = 0;
  // The mean of the target's points, and the mean of the body's vertices that the target should
  // show.
  virtual Vector3d Center() const = 0;
  virtual Vector3d VisibleCenter(const PosedBody& body) = 0;
};

}  // namespace vitruvia
