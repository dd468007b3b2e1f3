// Vertex correspondences between two meshes in the same pose.
#pragma once

#include <vector>

#include "geometry/mesh.h"

namespace vitruvia {

// For each point the index of the nearest of `vertices`, which must not be empty.
std::vector<int> NearestVertices(const std::vector<Vector3f>& points,
                                 const std::vector<Vector3f>& vertices);

}  // namespace vitruvia
