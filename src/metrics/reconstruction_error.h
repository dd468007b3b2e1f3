// Distance of an estimated surface to the nearest observed points and to the nearest point of the
// true surface: unlike vertex_error.h, insensitive to sliding along the surface.
#pragma once

#include <vector>

#include "geometry/mesh.h"

namespace vitruvia {

// The distance of each point to the nearest of `observed`, metres (paper B, sec. 5.3: visible
// vertices against the observed points). Infinite where a coordinate is not finite or nothing was
// observed.
std::vector<double> DistancesToPoints(const std::vector<Vector3f>& points,
                                      const std::vector<Vector3f>& observed);

// The distance of each point to the closest point of a surface, metres; infinite where a coordinate
// is not finite. The mesh must have triangles.
std::vector<double> DistancesToSurface(const std::vector<Vector3f>& points,
                                       const TriangleMesh& surface);

}  // namespace vitruvia
