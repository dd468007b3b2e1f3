#include "tracking/agreement.h"

namespace vitruvia {
namespace {

double Share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

double Agreement::presence() const {
  constexpr double kEnoughEvaluated = 0.1;
  return visible_fraction_evaluated >= kEnoughEvaluated ? confirmed : explained;
}

Agreement MeasureAgreement(std::size_t points, std::size_t unexplained, std::size_t visible,
                           const VertexClasses& classes) {
  const std::size_t confirmed = classes.near_surface.size();
  const std::size_t evaluated = confirmed + classes.elsewhere.size();
  return {Share(points - unexplained, points), Share(confirmed, evaluated),
          Share(evaluated, visible)};
}

}  // namespace vitruvia
