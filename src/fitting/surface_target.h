// A surface as the target of a fit: whole or in part, of one piece or several.
#pragma once

#include "fitting/fit_target.h"
#include "search/kd_tree.h"

namespace vitruvia {

// Points with outward normals.
struct OrientedPoints {
  std::vector<Vector3f> points, normals;
};

// `count` points that cover the surface evenly: the same for the same mesh, whatever the sizes of
// its triangles. DataError if the mesh has no area.
OrientedPoints SampleSurface(const TriangleMesh& mesh, int count);

// `count` of them, evenly spaced by index; all if there are no more.
OrientedPoints EvenlyChosen(const OrientedPoints& all, int count);

// How far outside of a body its surface may lie.
enum class Clothing { kNone, kLoose };

class SurfaceTarget final : public FitTarget {
 public:
  // `seekers` of the points look for the body; the body looks for all of them.
  SurfaceTarget(OrientedPoints points, int seekers, Clothing clothing);

  void FindPairs(const PosedBody& body, double cutoff_m, std::vector<FitPair>& pairs) override;
  MutualDistance Measure(const PosedBody& body, const NearFar& limits) override;
  Vector3d Centroid() const override { return centroid_; }
  Vector3d VisibleCentroid(const PosedBody& body) override;

 private:
  OrientedPoints points_, seekers_;
  Clothing clothing_;
  Vector3d centroid_;
  KdTree tree_, body_tree_;
  std::vector<KdTree::Neighbor> neighbors_;
};

}  // namespace vitruvia
