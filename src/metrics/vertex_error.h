// Distance of an estimated surface from the true one, vertex by vertex.
#pragma once

#include <vector>

#include "geometry/camera.h"
#include "geometry/mesh.h"
#include "geometry/surface_map.h"
#include "geometry/zbuffer.h"

namespace vitruvia {

// Where the estimate's vertices belong on the true surface: by closest point in the rest pose,
// which both meshes share, so that the meshes may differ. The same rest mesh gives the vertices
// themselves.
class RestCorrespondence {
 public:
  RestCorrespondence(const TriangleMesh& estimate_rest, const TriangleMesh& true_rest);

  // The true positions of the estimate's vertices, given the true mesh's posed vertices.
  std::vector<Vector3f> TruePositions(const std::vector<Vector3f>& true_vertices) const;

 private:
  std::vector<SurfacePoint> points_;
  std::vector<Triangle> true_triangles_;
};

// ‖estimate_i − truth_i‖ in metres. A pair that is not finite counts as infinitely far.
std::vector<double> VertexErrors(const std::vector<Vector3f>& estimate,
                                 const std::vector<Vector3f>& truth);

// Which of the true positions the camera sees: those no more than visible_within_m behind the
// z-buffer of the true mesh at their nearest pixel.
std::vector<bool> VisiblePoints(const std::vector<Vector3f>& points,
                                const DepthImage& rendered_truth, const PinholeCamera& camera,
                                double visible_within_m);

// Mean and maximum over all, visible and hidden vertices, metres; NaN where there are none: an
// error that was not measured is absent, not zero.
struct VertexErrorSummary {
  double mean_m, max_m;
  double visible_mean_m, visible_max_m;
  double hidden_mean_m, hidden_max_m;
};
VertexErrorSummary Summarize(const std::vector<double>& errors_m, const std::vector<bool>& visible);

}  // namespace vitruvia
