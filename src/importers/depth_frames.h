// Frames of a recording as depth in metres, oriented as the sequence has them.
#pragma once

#include <filesystem>
#include <vector>

#include "geometry/camera.h"
#include "geometry/image.h"
#include "importers/depth_orientation.h"

namespace vitruvia {

struct StoredDepth {
  PinholeCamera camera;  // of the stored images
  double unit_m = 0.001;
  std::vector<double> invalid;  // stored values that are no measurement
  OrientationSettings orientation;
};

// An image or an organised point cloud, whose z is depth. 0, negative numbers, NaN and infinities
// are no measurement. DataError naming the file if it is damaged, of another size than the camera,
// or a cloud whose points do not lie on the camera's rays.
DepthImage ReadDepthFrame(const std::filesystem::path& file, const StoredDepth& stored);

}  // namespace vitruvia
