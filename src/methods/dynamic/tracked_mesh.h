// The mesh that is tracked, made of a subject's for each of the paper's modes.
#pragma once

#include "body/body_model.h"
#include "methods/dynamic/settings.h"

namespace vitruvia::dynamic {

// The subject's vertices come first, in its order; further ones close holes.
struct TrackedMesh {
  std::vector<Vector3f> vertices;  // subject frame, metres
  std::vector<Vector3f> normals;   // unit; zero where a vertex belongs to no triangle
  std::vector<Triangle> triangles;
  SkinWeights weights;
};

// The subject as it is.
TrackedMesh SmoothMesh(const BodyModel& subject);

// The mesh in one part for each bone (paper B, sec. 5.1): a vertex follows the bone of its largest
// weight alone, triangles across bones go, and every hole is closed by a fan round its middle.
TrackedMesh RigidSegments(const BodyModel& subject);

// About one of `stride` vertices of each set of bones, evenly spread over their order: what a
// coarse pose step looks at. Indices, ascending.
std::vector<int> SpreadVertices(const TrackedMesh& mesh, int stride);

// Those vertices alone, without triangles, with the normals that they have.
TrackedMesh Subset(const TrackedMesh& mesh, const std::vector<int>& vertices);

}  // namespace vitruvia::dynamic
