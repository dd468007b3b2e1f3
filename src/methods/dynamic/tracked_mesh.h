// The tracked mesh, derived from the subject's mesh for each of the paper's modes.
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

// The subject's mesh, unchanged.
TrackedMesh SmoothMesh(const BodyModel& subject);

// The mesh in one part for each bone (paper B, sec. 5.1): a vertex follows only the bone of its
// largest weight, triangles across bones are removed, and every hole is closed by a fan of
// triangles round its centre.
TrackedMesh RigidSegments(const BodyModel& subject);

// About one of `stride` vertices of each set of bones, evenly spread over their order, for a coarse
// pose step. Ascending indices.
std::vector<int> SpreadVertices(const TrackedMesh& mesh, int stride);

// Only those vertices, with their normals and without triangles.
TrackedMesh Subset(const TrackedMesh& mesh, const std::vector<int>& vertices);

}  // namespace vitruvia::dynamic
