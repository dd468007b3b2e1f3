// Depth images whose surfaces are known in closed form, or drawn from meshes.
#pragma once

#include <vector>

#include "core/worker_team.h"
#include "geometry/camera.h"
#include "geometry/image.h"
#include "geometry/mesh.h"
#include "learning/scan/settings.h"

namespace vitruvia {

struct Ball {
  Vector3d center;  // subject frame
  double radius_m;
};

// 160×120 pixels, the field of view of a Kinect.
PinholeCamera SmallCamera();

// The camera at `position` that looks at `target`, upright; both in the subject frame.
Rigidd CameraLookingAt(const Vector3d& position, const Vector3d& target);

// Exact depth of balls.
DepthImage ViewOf(const std::vector<Ball>& balls, const PinholeCamera& camera,
                  const Rigidd& camera_from_subject);
// Exact depth of the plane z = 0 of the subject frame.
DepthImage ViewOfPlane(const PinholeCamera& camera, const Rigidd& camera_from_subject);
// Depth of a mesh in the subject frame.
DepthImage ViewOf(const TriangleMesh& mesh, const PinholeCamera& camera,
                  const Rigidd& camera_from_subject);

// A scanned space of ± half_m round the origin.
VolumeSettings SmallVolume(double half_m, double voxel_m, double truncation_m);

// The figure that alignment is tried on: balls at places that no rotation maps to each other.
std::vector<Ball> Cluster();

// A team of that many threads, made once. MatchPointToPlane and others take one.
WorkerTeam& Team(int threads);

}  // namespace vitruvia
