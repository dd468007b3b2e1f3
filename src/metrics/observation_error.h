// Agreement of an estimated surface with the observed depth. Needs no ground truth, but is
// insensitive to tangential sliding of the surface and to the positions of hidden limbs.
#pragma once

#include <span>
#include <vector>

#include "geometry/camera.h"
#include "geometry/mesh.h"
#include "geometry/zbuffer.h"

namespace vitruvia {

// An observed point farther than this from the model is unexplained; a model pixel more than this
// in front of the measured depth lies in observed free space.
inline constexpr double kUnexplainedAbove_m = 0.05;

struct ObservationError {
  std::vector<double> points_to_model_m;  // each observed point to the closest point of the surface
  std::vector<double> model_to_points_m;  // each visible vertex to the nearest observed point
  // Intersection over union of the silhouettes; NaN if both are empty.
  double silhouette_overlap = 0.0;
  double points_unexplained = 0.0;  // share of the observed points
  double model_in_front = 0.0;      // share of the model's pixels that lie in observed free space
};

// `person`: depth of the person alone; `scene`: depth with the room behind, where it is known;
// surface and depth are in the camera frame. About `most_points` observed points at most are used,
// evenly spread over the image. If the person is not measured, the lists are empty and the shares
// NaN.
ObservationError CompareWithObservation(const TriangleMesh& surface, const DepthImage& person,
                                        const DepthImage& scene, const PinholeCamera& camera,
                                        double visible_within_m, int most_points, ZBuffer& zbuffer);

// Points of another camera's depth, in the frame of the first camera, that the first did not see:
// behind its depth or outside its image.
std::vector<Vector3f> PointsUnseen(const std::vector<Vector3f>& points_in_camera,
                                   const DepthImage& scene, const PinholeCamera& camera,
                                   double within_m);

}  // namespace vitruvia
