// Maps between the learning mesh and the tracking mesh (paper A, sec. 6.2: 12,500 vertices for
// learning, 6,252 for tracking).
#pragma once

#include "geometry/surface_map.h"
#include "learning/shape/shape_space.h"

namespace vitruvia {

struct TrackingTemplate {
  // The kept vertices of the learning mesh, ascending: their shape and weights are copied.
  std::vector<int> kept;
  std::vector<Triangle> triangles;  // over the kept ones
  // Where each vertex of the learning mesh lies on the tracking mesh.
  std::vector<SurfacePoint> learning_on_tracking;
};

inline constexpr int kTrackingVertices = 6252;  // paper A, sec. 6.2

// By edge collapse of the learning mesh (geometry/decimation.h).
TrackingTemplate MakeTrackingTemplate(const TriangleMesh& learning_mesh,
                                      int target_vertices = kTrackingVertices);

// To the tracking mesh: exact, because its vertices are a subset.
BodyModel OnTrackingMesh(const BodyModel& learning_body, const TrackingTemplate& tracking);
ShapeSpace OnTrackingMesh(const ShapeSpace& space, const TrackingTemplate& tracking);

// Back to the learning mesh: by barycentric interpolation.
std::vector<Vector3f> PositionsOnLearningMesh(const std::vector<Vector3f>& tracking_vertices,
                                              const TrackingTemplate& tracking);
SkinWeights WeightsOnLearningMesh(const SkinWeights& tracking_weights,
                                  const TrackingTemplate& tracking);

}  // namespace vitruvia
