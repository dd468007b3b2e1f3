#include "tracking/tracker.h"

namespace vitruvia {

const char* Name(Outcome outcome) {
  switch (outcome) {
    case Outcome::kConverged:
      return "converged";
    case Outcome::kIterationLimit:
      return "iteration_limit";
    case Outcome::kLost:
      return "lost";
    case Outcome::kNoData:
      return "no_data";
  }
  return "";
}

}  // namespace vitruvia
