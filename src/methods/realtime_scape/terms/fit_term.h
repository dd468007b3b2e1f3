// Term 1, goodness of fit: |V1| + 3 (|V2| + |P2|) rows (paper A, eq. 7 and sec. 6.2).
#pragma once

#include "methods/realtime_scape/model.h"
#include "methods/realtime_scape/settings.h"
#include "solver/block_normal_equations.h"
#include "tracking/classification.h"

namespace vitruvia::realtime_scape {

// What the data ask of the model in one iteration, with frozen correspondences.
struct FitData {
  VertexClasses classes;    // V1 with its observed depths, V2
  std::vector<Pair> pairs;  // of V2 and P2
};

// The share of a residual's weight that a robust kernel leaves to it: 1 at 0.
double RobustWeight(RobustKernel kernel, double residual_m, double scale_m);

// Adds the rows of both kinds to the normal equations: unknowns are per bone (r, t), a rotation
// exp(r) applied on the left about the bone's centre and a translation of the centre in length
// units. Lengths are divided by length_unit_m. Returns the energy that it added.
double AddFitTerm(const Model& model, const BodyPose& pose, const PinholeCamera& camera,
                  const FitData& data, const FitSettings& settings, double length_unit_m,
                  BlockNormalEquations& equations);

}  // namespace vitruvia::realtime_scape
