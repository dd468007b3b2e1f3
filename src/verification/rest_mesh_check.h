// Checks that the true surface in the rest pose and the subject are the same person at the same
// place.
#pragma once

#include <string>

#include "body/body_model.h"
#include "verification/finding.h"

namespace vitruvia {

// Rejects a rest mesh with a different unit, place, axes or pose. Accepts clothes, a different
// triangulation and small differences of shape. `name` is the mesh's name in messages.
Findings CheckRestMesh(const TriangleMesh& true_rest, const BodyModel& subject,
                       const std::string& name);

}  // namespace vitruvia
