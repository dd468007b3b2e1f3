#include "learning/skinning/examples.h"

#include <fmt/format.h>

namespace vitruvia::skinning {
namespace {

// The first vertex that is not finite, or -1.
std::ptrdiff_t FirstNotFinite(const std::vector<Vector3f>& vertices) {
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (!vertices[v].allFinite()) return static_cast<std::ptrdiff_t>(v);
  }
  return -1;
}

}  // namespace

std::string ExamplesProblem(const Examples& examples) {
  if (examples.rest.empty()) return "the rest pose has no vertices";
  if (examples.poses.empty()) return "there are no poses";
  if (const std::ptrdiff_t v = FirstNotFinite(examples.rest); v >= 0) {
    return fmt::format("rest pose: vertex {} is not finite", v);
  }
  for (std::size_t p = 0; p < examples.poses.size(); ++p) {
    if (examples.poses[p].size() != examples.rest.size()) {
      return fmt::format("pose {} has {} vertices, the rest pose {}", p, examples.poses[p].size(),
                         examples.rest.size());
    }
    if (const std::ptrdiff_t v = FirstNotFinite(examples.poses[p]); v >= 0) {
      return fmt::format("pose {}: vertex {} is not finite", p, v);
    }
  }
  return "";
}

}  // namespace vitruvia::skinning
