#include "methods/capsule_icp/capsule_icp.h"

#include "methods/capsule_icp/capsule_term.h"

namespace vitruvia::capsule_icp {

CapsuleIcp::CapsuleIcp(const Settings& settings)
    : ArticulatedTracker("Capsule ICP", settings.common), settings_(settings) {}

std::unique_ptr<articulated::DataTerm> CapsuleIcp::MakeDataTerm(const Subject& subject,
                                                                const ShapedBody& /*body*/,
                                                                const PinholeCamera& camera) const {
  return std::make_unique<CapsuleTerm>(subject, camera, settings_);
}

}  // namespace vitruvia::capsule_icp
