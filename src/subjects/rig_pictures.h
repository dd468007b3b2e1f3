// Strips of surfaces that show a rig.
#pragma once

#include "records/surface_strips.h"
#include "subjects/rig.h"

namespace vitruvia {

// The T-pose, then `count` evenly spread frames, each with the mesh, the registered body, the
// skinned subject, its bones, and its distance from the mesh (between corresponding vertices with
// RigSurface::kMesh, otherwise to the nearest point). Each is rotated so that the person faces the
// viewer.
std::vector<SurfaceStrip> RigStrips(const Rig& rig, const std::vector<TriangleMesh>& frames,
                                    int count);

}  // namespace vitruvia
