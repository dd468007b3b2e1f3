// Organised point clouds of the Point Cloud Library: a point for each pixel of a depth camera.
#pragma once

#include <filesystem>
#include <vector>

#include "geometry/mesh.h"

namespace vitruvia {

struct OrganisedCloud {
  int width = 0, height = 0;
  std::vector<Vector3f> points;  // in row-major order, as stored; NaN where nothing was measured
};

// Version 0.7, DATA ascii, binary or binary_compressed, with float32 fields x, y and z among
// others. DataError naming the file, what was expected and what was found: a damaged header, fields
// that are missing or of another type, a cloud without rows, data cut short.
OrganisedCloud ReadOrganisedPcd(const std::filesystem::path& file);

}  // namespace vitruvia
