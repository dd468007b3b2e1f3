// Reads frames of a recording as depth in metres, in the orientation of the sequence.
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
  std::vector<double> invalid;  // stored values that mean "no measurement"
  OrientationSettings orientation;
};

// Reads an image or an organised point cloud, whose z is depth. 0, negative numbers, NaN and
// infinities mean "no measurement". DataError naming the file if it is damaged, if its size is not
// the camera's, or if the points of a cloud do not lie on the camera's rays.
DepthImage ReadDepthFrame(const std::filesystem::path& file, const StoredDepth& stored);

}  // namespace vitruvia
