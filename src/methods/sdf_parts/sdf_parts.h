// Rigid parts with signed distance fields, after DART (Schmidt, Newcombe & Fox 2014), as paper B
// compares with it: the body cut into closed pieces along its bones. docs/baselines.md lists what
// comes from DART's code and what is added here.
//
// Departures: the prediction is rasterised instead of traced through the fields; the distance from
// the observation is that of the nearest point instead of a grid's; the pose is parametrised by
// anatomical angles with their limits as bounds; a prior about the predicted pose replaces the
// damping.
#pragma once

#include "articulated/articulated_tracker.h"
#include "methods/sdf_parts/settings.h"

namespace vitruvia::sdf_parts {

class SdfParts final : public articulated::ArticulatedTracker {
 public:
  explicit SdfParts(const Settings& settings);

 private:
  std::unique_ptr<articulated::DataTerm> MakeDataTerm(const Subject& subject,
                                                      const ShapedBody& body,
                                                      const PinholeCamera& camera) const override;

  Settings settings_;
};

}  // namespace vitruvia::sdf_parts
