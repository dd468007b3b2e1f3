// Points and normals at the pixels of a camera, and their computation from a depth image.
#pragma once

#include <vector>

#include "core/worker_team.h"
#include "geometry/camera.h"
#include "geometry/image.h"
#include "geometry/mesh.h"
#include "learning/scan/settings.h"

namespace vitruvia {

// A pixel without a surface has a zero normal and an undefined point.
struct PointMap {
  Image<Vector3f> points;   // metres
  Image<Vector3f> normals;  // unit length, towards the camera

  bool Has(int u, int v) const { return normals(u, v) != Vector3f::Zero(); }
};

// Bilateral filter of depth (Tomasi & Manduchi 1998; KF, eq. 2). A sigma of 0 disables it.
DepthImage Smoothed(const DepthImage& depth, const SmoothingSettings& settings, WorkerTeam& team);

// Half the resolution: each pixel is the mean of those of its four source pixels that lie within
// jump_m of the nearest one (KF, sec. 3.2).
DepthImage Halved(const DepthImage& depth, double jump_m);
PinholeCamera Halved(const PinholeCamera& camera);

// Points in the camera frame from `depth`; normals from `smooth_depth`, which must have a
// measurement wherever `depth` has. (A least-squares fit averages the points' noise itself, and
// smoothing would move points on curved surfaces into the body.) Normals come from the differences
// to the neighbours on both sides, or to one of them if the other lies beyond a jump of
// depth_jump_m or has no depth.
PointMap MakePointMap(const DepthImage& depth, const DepthImage& smooth_depth,
                      const PinholeCamera& camera, double depth_jump_m, WorkerTeam& team);

}  // namespace vitruvia
