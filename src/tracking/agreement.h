// Agreement of a posed model with a frame.
#pragma once

#include <cstddef>

#include "tracking/classification.h"

namespace vitruvia {

struct Agreement {
  // Share of the cloud's points that the rendered model explains.
  double explained = 0.0;
  // |V1| / (|V1| + |V2|): share of V1 in the visible vertices that the frame can confirm or
  // contradict.
  double confirmed = 0.0;
  // Share of V1 and V2 in all visible vertices; the others are occluded in the frame.
  double visible_fraction_evaluated = 0.0;

  // Score in 0 … 1 for the body being at the model's pose. It is `confirmed`, so that objects in
  // front of or beside the body do not lower it; it is `explained` if too few vertices can be
  // evaluated.
  double presence() const;
  // Of two poses for one frame the one with the higher score is preferred.
  double score() const { return explained * confirmed; }
};

// `points` is the size of the cloud, `unexplained` the size of P2, `visible` the number of visible
// vertices. A share of nothing is 0.
Agreement MeasureAgreement(std::size_t points, std::size_t unexplained, std::size_t visible,
                           const VertexClasses& classes);

}  // namespace vitruvia
