// What a rig looks like: strips of surfaces for a sheet of pictures.
#pragma once

#include "records/surface_strips.h"
#include "subjects/rig.h"

namespace vitruvia {

// The T-pose, then `count` frames evenly spread over all: the mesh, the registered body, the
// skinned subject, its bones, and how far it is from the mesh (vertex by vertex of a mesh's own
// surface, to the nearest point otherwise). Each is turned so that the person faces the viewer.
std::vector<SurfaceStrip> RigStrips(const Rig& rig, const std::vector<TriangleMesh>& frames,
                                    int count);

}  // namespace vitruvia
