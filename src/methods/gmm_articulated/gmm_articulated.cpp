#include "methods/gmm_articulated/gmm_articulated.h"

#include "methods/gmm_articulated/mixture_term.h"

namespace vitruvia::gmm_articulated {

GmmArticulated::GmmArticulated(const Settings& settings)
    : ArticulatedTracker("Articulated mixture", settings.common), settings_(settings) {}

std::unique_ptr<articulated::DataTerm> GmmArticulated::MakeDataTerm(
    const Subject& /*subject*/, const ShapedBody& body, const PinholeCamera& camera) const {
  return std::make_unique<MixtureTerm>(body, camera, settings_);
}

}  // namespace vitruvia::gmm_articulated
