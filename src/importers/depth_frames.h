// Reads frames of a recording as depth in metres, in the orientation of the sequence.
#pragma once

#include <filesystem>
#include <string>
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
  std::string numbers;  // how every file stores them (StoredNumbers); "": any way
};

// How a file stores its numbers, for people; the same for all files that a camera's software wrote.
std::string StoredNumbers(const std::filesystem::path& file);

// Reads an image or an organised point cloud, whose z is depth. 0, negative numbers, NaN and
// infinities mean "no measurement". DataError naming the file if it is damaged, if its size is not
// the camera's, if it stores other numbers than stated, or if the points of a cloud do not lie on
// the camera's rays.
DepthImage ReadDepthFrame(const std::filesystem::path& file, const StoredDepth& stored);

}  // namespace vitruvia
