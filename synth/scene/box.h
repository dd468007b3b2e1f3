// The six faces of a box.
#pragma once

#include <functional>

#include "geometry/mesh.h"

namespace vitruvia {

// Adds the two triangles of a quad, seen counter-clockwise from outside.
void AddQuad(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d,
             TriangleMesh& mesh);

// `corner` gives the place in the mesh's frame of the corner on sides (±1, ±1, ±1) of x, y and z.
void AddBox(const std::function<Vector3d(const Vector3d& sides)>& corner, TriangleMesh& mesh);

}  // namespace vitruvia
