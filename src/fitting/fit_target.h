// What a body is fitted to: a surface or a depth frame, seen through the pairs that it asks for.
#pragma once

#include <vector>

#include "fitting/shaped_body.h"

namespace vitruvia {

// A vertex of the body and where it should be. The residual is the distance along the normal, and
// a share of the distance in space.
struct FitPair {
  int vertex = -1;
  Vector3f target, normal;  // world frame; the normal of unit length
  float weight = 1.0f;
};

// How near two surfaces are, both ways. The distance of a point from a surface that is known by
// points is the one along the normal, or what its distance in space exceeds the points' spacing by
// if that is more. Distances are truncated at `far_m`; what is not to be expected (behind
// something, out of the image) does not count.
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
  // The mean of the points, and of the body's vertices that they should show.
  virtual Vector3d Center() const = 0;
  virtual Vector3d VisibleCenter(const PosedBody& body) = 0;
};

}  // namespace vitruvia
