// Training data for skinning weights: one rest pose and the same surface in other poses.
#pragma once

#include <string>
#include <vector>

#include "geometry/mesh.h"

namespace vitruvia::skinning {

struct Examples {
  std::vector<Vector3f> rest;                // V, metres
  std::vector<std::vector<Vector3f>> poses;  // P × V, metres, vertex by vertex as in `rest`
};

// "" if the examples are valid, otherwise a message that names the pose, the vertex and the
// problem.
std::string ExamplesProblem(const Examples& examples);

}  // namespace vitruvia::skinning
