// Registration of an articulated mesh by a mixture of Gaussians, after Ye & Yang 2014, the method
// on which paper B builds: the observed points are samples of Gaussians about the visible vertices;
// expectation–maximisation moves the joints. docs/baselines.md separates what the paper states from
// interpretations.
//
// Departures: the subject's shape is given and not estimated; the pose is parametrised by
// anatomical angles with their limits as bounds; the prediction is a share of the last velocity.
#pragma once

#include "articulated/articulated_tracker.h"
#include "methods/gmm_articulated/settings.h"

namespace vitruvia::gmm_articulated {

class GmmArticulated final : public articulated::ArticulatedTracker {
 public:
  explicit GmmArticulated(const Settings& settings);

 private:
  std::unique_ptr<articulated::DataTerm> MakeDataTerm(const Subject& subject,
                                                      const ShapedBody& body,
                                                      const PinholeCamera& camera) const override;

  Settings settings_;
};

}  // namespace vitruvia::gmm_articulated
