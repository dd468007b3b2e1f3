#include "tracking/agreement.h"

#include "math/share.h"

namespace vitruvia {

double Agreement::presence() const {
  constexpr double kEnoughEvaluated = 0.1;
  return visible_fraction_evaluated >= kEnoughEvaluated ? confirmed : explained;
}

Agreement MeasureAgreement(std::size_t points, std::size_t unexplained, std::size_t visible,
                           const VertexClasses& classes) {
  const std::size_t confirmed = classes.near_surface.size();
  const std::size_t evaluated = confirmed + classes.elsewhere.size();
  return {ShareOr(points - unexplained, points, 0.0), ShareOr(confirmed, evaluated, 0.0),
          ShareOr(evaluated, visible, 0.0)};
}

}  // namespace vitruvia
