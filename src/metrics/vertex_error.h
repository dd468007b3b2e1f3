// Distance of an estimated surface from the true one, vertex by vertex.
#pragma once

#include <vector>

#include "geometry/camera.h"
#include "geometry/mesh.h"
#include "geometry/surface_map.h"
#include "geometry/zbuffer.h"

namespace vitruvia {

// Maps the estimate's vertices to the true surface, by closest point in the common rest pose, so
// that the meshes may differ. With identical rest meshes each vertex maps to itself.
class RestCorrespondence {
 public:
  RestCorrespondence(const TriangleMesh& estimate_rest, const TriangleMesh& true_rest);

  // The true positions of the estimate's vertices, given the true mesh's posed vertices.
  std::vector<Vector3f> TruePositions(const std::vector<Vector3f>& true_vertices) const;

 private:
  std::vector<SurfacePoint> points_;
  std::vector<Triangle> true_triangles_;
};

// ‖estimate_i − truth_i‖ in metres. The error of a pair that is not finite is infinite.
std::vector<double> VertexErrors(const std::vector<Vector3f>& estimate,
                                 const std::vector<Vector3f>& truth);

// Whether the camera sees each of the points: a visible point is at most visible_within_m behind
// the z-buffer of the true mesh at its nearest pixel.
std::vector<bool> VisiblePoints(const std::vector<Vector3f>& points,
                                const DepthImage& rendered_truth, const PinholeCamera& camera,
                                double visible_within_m);

// Mean and maximum over all, visible and hidden vertices, metres; NaN for a class without vertices.
struct VertexErrorSummary {
  double mean_m, max_m;
  double visible_mean_m, visible_max_m;
  double hidden_mean_m, hidden_max_m;
};
VertexErrorSummary Summarize(const std::vector<double>& errors_m, const std::vector<bool>& visible);

}  // namespace vitruvia
