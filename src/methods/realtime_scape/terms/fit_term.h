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

// The weight of a row: 1 without noise, the model's variance over that of model and measurement
// otherwise. `point` is where the row's measurement lies (camera frame), `direction` the unit
// vector along which the row measures.
double NoiseWeight(const NoiseSettings& noise, const Vector3d& point, const Vector3d& direction);

// Adds the rows of V1 (`classes`, with observed depths) and of the pairs of V2 and P2. Their
// correspondences are constants. Lengths are divided by length_unit_m.
void AddFitTerm(const Model& model, const BodyPose& pose, const PinholeCamera& camera,
                const VertexClasses& classes, const std::vector<Pair>& pairs,
                const FitSettings& settings, double length_unit_m, BlockNormalEquations& equations);

}  // namespace vitruvia::realtime_scape
