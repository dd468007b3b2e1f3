// What skinning weights are learnt from: one rest pose and the same surface in other poses.
#pragma once

#include <string>
#include <vector>

#include "geometry/mesh.h"

namespace vitruvia::skinning {

struct Examples {
  std::vector<Vector3f> rest;                // V, metres
  std::vector<std::vector<Vector3f>> poses;  // P × V, metres, vertex by vertex as in `rest`
};

// "" if the examples can be learnt from, otherwise what is wrong with which pose and vertex.
std::string ExamplesProblem(const Examples& examples);

}  // namespace vitruvia::skinning
