// Whether the true surface at rest and the subject are the same person in the same place.
#pragma once

#include <string>

#include "body/body_model.h"
#include "verification/finding.h"

namespace vitruvia {

// Refuses a rest mesh of another unit, another place, other axes or another pose. Clothes, another
// triangulation and small differences of shape pass. `name` is what messages call the mesh.
Findings CheckRestMesh(const TriangleMesh& true_rest, const BodyModel& subject,
                       const std::string& name);

}  // namespace vitruvia
