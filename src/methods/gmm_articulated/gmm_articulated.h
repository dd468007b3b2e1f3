// Registration of an articulated mesh by a mixture of Gaussians, after Ye & Yang 2014, whose method
// paper B leans on: the observed points are drawn from Gaussians about the visible vertices;
// expectation–maximisation moves the joints. docs/baselines.md says what is sure and what is a
// reading.
//
// Departures: the subject's shape is given and not estimated; angles are anatomical and their
// limits bounds; the prediction is a share of the last velocity.
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
