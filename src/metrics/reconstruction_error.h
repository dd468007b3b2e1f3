// How far an estimated surface lies from what was observed, and from the true surface, wherever on
// it: unlike vertex_error.h, sliding along the surface costs nothing.
#pragma once

#include <vector>

#include "geometry/mesh.h"

namespace vitruvia {

// The distance of each point to the nearest of `observed`, metres (paper B, sec. 5.3: visible
// vertices against the observed points). Infinite where a coordinate is not finite or nothing was
// observed.
std::vector<double> DistancesToPoints(const std::vector<Vector3f>& points,
                                      const std::vector<Vector3f>& observed);

// The distance of each point to the nearest place of a surface, metres; infinite where a coordinate
// is not finite. The mesh must have triangles.
std::vector<double> DistancesToSurface(const std::vector<Vector3f>& points,
                                       const TriangleMesh& surface);

}  // namespace vitruvia
