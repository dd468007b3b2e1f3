// How well an estimated surface explains what the camera saw. Needs no truth: a surface that slides
// along itself, or a hidden limb that is elsewhere, costs little or nothing here.
#pragma once

#include <span>
#include <vector>

#include "geometry/camera.h"
#include "geometry/mesh.h"
#include "geometry/zbuffer.h"

namespace vitruvia {

// An observed point farther than this from the model is not explained by it; a model pixel nearer
// than this before the measured depth stands where the camera looked through.
inline constexpr double kUnexplainedAbove_m = 0.05;

struct ObservationError {
  std::vector<double> points_to_model_m;  // each observed point to the nearest place of the surface
  std::vector<double> model_to_points_m;  // each visible vertex to the nearest observed point
  // Pixels that both have / pixels that either has; NaN where neither has any.
  double silhouette_overlap = 0.0;
  double points_unexplained = 0.0;  // share of the observed points
  double model_in_front = 0.0;  // share of the model's pixels behind which something is measured
};

// `person`: depth of the person alone; `scene`: with the room behind, where it is known; both in
// the camera's frame as the posed surface is. Of the observed points at most about `most_points`
// are taken, evenly spread over the image. Nothing is compared where the person is not measured:
// the lists are empty and the shares NaN.
ObservationError CompareWithObservation(const TriangleMesh& surface, const DepthImage& person,
                                        const DepthImage& scene, const PinholeCamera& camera,
                                        double visible_within_m, int most_points, ZBuffer& zbuffer);

// Points of another camera's depth, in the frame of the first, that the first did not see: behind
// its depth or outside its image.
std::vector<Vector3f> PointsUnseen(const std::vector<Vector3f>& points_in_camera,
                                   const DepthImage& scene, const PinholeCamera& camera,
                                   double within_m);

}  // namespace vitruvia
