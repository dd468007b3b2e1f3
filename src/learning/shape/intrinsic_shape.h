// Intrinsic shape (paper A, sec. 5, eq. 6): fits the shape space to a scan of a person.
//
// min over θ of E_ap + λ₁ E_diff. E_diff is the bidirectional distance of surface and scan, point
// to plane, in units of `length_unit_m`; pairs farther apart than a shrinking cutoff, or whose
// normals disagree, are rejected, so holes of the scan have no effect. E_ap is ‖θ‖² (θ in standard
// deviations) over the subspace that leaves height, weight and sex as given. Departures from the
// paper: the T-pose of a scan is never perfect, so every joint may rotate slightly, under a prior;
// height and weight are those measured on the surface. Solved by Gauss–Newton with analytic
// derivatives.
#pragma once

#include <string>

#include "config/settings.h"
#include "geometry/point_sets.h"
#include "learning/shape/attribute_subspace.h"
#include "learning/shape/posed_shape.h"

namespace vitruvia {

enum class AttributeUse {
  kHeld,     // eq. 6
  kIgnored,  // the whole space is searched, from its mean
};

struct IntrinsicShapeSettings {
  int components = 30;
  double lambda = 2.0;
  double length_unit_m = 0.05;
  int max_iterations = 20;
  double first_cutoff_m = 0.10, last_cutoff_m = 0.02;
  double normal_angle_deg = 60.0;
  double robust_m = 0.01;        // residual at which a pair's weight falls to a quarter
  double pose_slack_deg = 5.0;   // standard deviation of every joint's rotation
  double stop_m = 2e-5;          // mean movement of the surface at which the fit ends
  int scan_points = 12000;       // number of the scan's points that are paired to the body
  double least_coverage = 0.35;  // of each bone's surface by the scan
  double most_unusual = 5.0;     // attributes' standard deviations from the database's mean
  AttributeUse attributes = AttributeUse::kHeld;

  void Describe(Fields& fields);
  std::string Problem() const;
};

// Input of the fit: points with outward normals, in a frame with y up and the person facing +z.
using ScannedSurface = OrientedPoints;
ScannedSurface SurfaceOf(const TriangleMesh& scan);

struct IntrinsicShape {
  Eigen::VectorXd theta;
  PosedShape::Parameters pose;    // scan frame
  std::vector<Vector3f> in_scan;  // the fitted surface in the scan's pose, tracking mesh
  int iterations = 0;
  bool converged = false;
  double body_to_scan_mean_m = 0.0;  // point to plane, over pairs
  double scan_to_body_mean_m = 0.0;
  std::array<double, kBoneCount> coverage{};  // share of each bone's vertices with a partner
};

// `tracking` is the space restricted to the fewer vertices that are paired to the scan; attributes
// are measured on all vertices. DataError if the scan covers too little of a bone or does not have
// the given height; ConfigError if the attributes are beyond the database.
IntrinsicShape FitIntrinsicShape(const ShapeSpace& space, const ShapeSpace& tracking,
                                 const ScannedSurface& scan, const BodyAttributes& attributes,
                                 const IntrinsicShapeSettings& settings);

}  // namespace vitruvia
