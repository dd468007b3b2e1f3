// Sets of points on surfaces.
#pragma once

#include <vector>

#include "geometry/mesh.h"

namespace vitruvia {

// The mean of the points; the origin if there are none.
Vector3d Centroid(const std::vector<Vector3f>& points);

// Points with outward normals of unit length.
struct OrientedPoints {
  std::vector<Vector3f> points, normals;
};

// `count` of the points, evenly spaced by index; all of them if there are not more than `count`.
OrientedPoints EvenlyChosen(const OrientedPoints& all, int count);

// `count` points that cover the surface evenly: the same for the same mesh, whatever the sizes of
// its triangles. DataError if the mesh has no area.
OrientedPoints SampleSurface(const TriangleMesh& mesh, int count);

}  // namespace vitruvia
