// What a camera sees, as points and normals at its pixels, and how that is made of a depth image.
#pragma once

#include <vector>

#include "core/worker_team.h"
#include "geometry/camera.h"
#include "geometry/image.h"
#include "geometry/mesh.h"
#include "learning/scan/settings.h"

namespace vitruvia {

// A pixel without a surface has a zero normal; its point means nothing.
struct PointMap {
  Image<Vector3f> points;   // metres
  Image<Vector3f> normals;  // unit length, towards the camera

  bool Has(int u, int v) const { return normals(u, v) != Vector3f::Zero(); }
};

// Depth smoothed but for its edges (Tomasi & Manduchi 1998; KF, eq. 2). A sigma of 0 leaves it as
// it is.
DepthImage Smoothed(const DepthImage& depth, const SmoothingSettings& settings, WorkerTeam& team);

// Half the resolution: each pixel the mean of those of its four that lie within jump_m of the
// nearest one (KF, sec. 3.2).
DepthImage Halved(const DepthImage& depth, double jump_m);
PinholeCamera Halved(const PinholeCamera& camera);

// Points in the camera frame, of `depth`; normals of `smooth_depth`, which has a measurement
// wherever `depth` has. (A least-squares fit averages the points' noise out by itself, and
// smoothing would draw them into the body wherever that is round.) Normals come from the
// differences to the neighbours on either side, or to one of them where the other lies beyond a
// jump of depth_jump_m or has no depth.
PointMap MakePointMap(const DepthImage& depth, const DepthImage& smooth_depth,
                      const PinholeCamera& camera, double depth_jump_m, WorkerTeam& team);

}  // namespace vitruvia
