// Articulated ICP with capsules: the model of Wei, Zhang & Chai 2012 (cylinders measured for the
// person, depth difference and silhouette) and of Ganapathi et al. 2012 (closest points, free
// space), in one tracker. docs/baselines.md lists what comes from the papers and what is added
// here.
//
// Departures: the capsules are fitted to the subject's mesh; the pose is parametrised by anatomical
// angles with their limits as bounds; there is no detector of body parts.
#pragma once

#include "articulated/articulated_tracker.h"
#include "methods/capsule_icp/settings.h"

namespace vitruvia::capsule_icp {

class CapsuleIcp final : public articulated::ArticulatedTracker {
 public:
  explicit CapsuleIcp(const Settings& settings);

 private:
  std::unique_ptr<articulated::DataTerm> MakeDataTerm(const Subject& subject,
                                                      const ShapedBody& body,
                                                      const PinholeCamera& camera) const override;

  Settings settings_;
};

}  // namespace vitruvia::capsule_icp
