#include "methods/sdf_parts/sdf_parts.h"

#include "methods/sdf_parts/parts_term.h"

namespace vitruvia::sdf_parts {

SdfParts::SdfParts(const Settings& settings)
    : ArticulatedTracker("SDF parts", settings.common), settings_(settings) {}

std::unique_ptr<articulated::DataTerm> SdfParts::MakeDataTerm(const Subject& subject,
                                                              const ShapedBody& /*body*/,
                                                              const PinholeCamera& camera) const {
  return std::make_unique<PartsTerm>(subject, camera, settings_);
}

}  // namespace vitruvia::sdf_parts
