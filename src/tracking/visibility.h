// Vertices visible to the camera.
#pragma once

#include <vector>

#include "geometry/camera.h"
#include "geometry/image.h"
#include "geometry/mesh.h"

namespace vitruvia {

// Indices, ascending, of the vertices whose depth differs by less than tolerance_m from the
// rendered depth at their nearest pixel (paper A, sec. 6.2: 0.002 m). `rendered` is the depth of
// the same vertices' mesh, 0 where nothing was drawn.
void FindVisibleVertices(const std::vector<Vector3f>& vertices_in_camera,
                         const DepthImage& rendered, const PinholeCamera& camera, float tolerance_m,
                         std::vector<int>& visible);

}  // namespace vitruvia
