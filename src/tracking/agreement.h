// How well a posed model and a frame agree.
#pragma once

#include <cstddef>

#include "tracking/classification.h"

namespace vitruvia {

struct Agreement {
  // Share of the cloud's points that the rendered model explains.
  double explained = 0.0;
  // Share of V1 in V1 and V2: of the visible vertices that the frame can confirm or contradict.
  double confirmed = 0.0;
  // Share of V1 and V2 in all visible vertices; the others lie behind something.
  double visible_fraction_evaluated = 0.0;

  // How likely the body is where the model is, 0 … 1: `confirmed`, so that an object before or
  // beside the body does not count against it; `explained` where so little of the model can be
  // evaluated that only the cloud can tell.
  double presence() const;
  // Of two poses for one frame the one with the higher score is preferred.
  double score() const { return explained * confirmed; }
};

// `points` is the size of the cloud, `unexplained` the size of P2, `visible` the number of visible
// vertices. A share of nothing is 0.
Agreement MeasureAgreement(std::size_t points, std::size_t unexplained, std::size_t visible,
                           const VertexClasses& classes);

}  // namespace vitruvia
