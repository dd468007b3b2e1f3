// Term 1, goodness of fit: |V1| + 3 (|V2| + |P2|) rows (paper A, eq. 7 and sec. 6.2).
#pragma once

#include <vector>

#include "methods/realtime_scape/model.h"
#include "methods/realtime_scape/settings.h"
#include "solver/block_normal_equations.h"
#include "tracking/classification.h"

namespace vitruvia::realtime_scape {

// The factor by which a robust kernel reduces a residual's weight: 1 at 0.
double RobustWeight(RobustKernel kernel, double residual_m, double scale_m);

// Adds the rows of V1 (`classes`, with observed depths) and of the pairs of V2 and P2. Their
// correspondences are constants. Lengths are divided by length_unit_m.
void AddFitTerm(const Model& model, const BodyPose& pose, const PinholeCamera& camera,
                const VertexClasses& classes, const std::vector<Pair>& pairs,
                const FitSettings& settings, double length_unit_m, BlockNormalEquations& equations);

}  // namespace vitruvia::realtime_scape
