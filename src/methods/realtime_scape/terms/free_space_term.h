// Free-space term: penalises visible vertices where the frame shows empty space. Not in paper A,
// which pairs such a vertex (V2) with the nearest observed point if there is one nearby, and
// otherwise ignores it.
#pragma once

#include <vector>

#include "methods/realtime_scape/model.h"
#include "methods/realtime_scape/settings.h"
#include "solver/block_normal_equations.h"
#include "tracking/classification.h"

namespace vitruvia::realtime_scape {

// Visible vertices in free space, each paired with the nearest place outside it.
struct FreeSpace {
  std::vector<Pair> ways_out;
};

// Of the vertices that no captured pixel explains (V2): one in front of the captured surface leaves
// along its line of sight; one where nothing is measured leaves across it, to the nearest measured
// pixel. Where the border of the image is nearer, either leaves the image: what is beside it may be
// anywhere.
void FindFreeSpace(const std::vector<Vector3f>& vertices, const VertexClasses& classes,
                   const DepthImage& captured, const PinholeCamera& camera,
                   const FitSettings& settings, FreeSpace& free_space);

// Adds weight · ‖vertex − way out‖² for each, along the line between them, with the fit's robust
// kernel. The ways out are constants. Lengths are divided by length_unit_m.
void AddFreeSpaceTerm(const Model& model, const BodyPose& pose, const FreeSpace& free_space,
                      const FitSettings& settings, double weight, double length_unit_m,
                      BlockNormalEquations& equations);

}  // namespace vitruvia::realtime_scape
