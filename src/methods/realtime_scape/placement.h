// Puts the rest pose onto the first frame.
#pragma once

#include "geometry/mesh_rasterizer.h"
#include "geometry/point_cloud.h"
#include "methods/realtime_scape/model.h"
#include "methods/realtime_scape/settings.h"

namespace vitruvia::realtime_scape {

// camera_from_subject of a body that stands in the rest pose, upright and facing the camera:
// centroid on centroid, then trimmed rigid closest-point iterations of the cloud against the
// visible vertices. The pose that these start from is as wrong as the settings ask.
Rigidd PlaceRestPose(const Model& model, const PointCloud& cloud, const PinholeCamera& camera,
                     const FitSettings& fit, const PlacementSettings& settings,
                     MeshRasterizer& rasterizer);

}  // namespace vitruvia::realtime_scape
