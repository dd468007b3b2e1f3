// Base class of trackers of a body in anatomical angles. It implements everything except the data
// term: first placement, prediction, iterations, detection of loss and recovery, and the subject's
// surface driven by the bones.
#pragma once

#include <memory>
#include <optional>

#include "articulated/data_term.h"
#include "articulated/settings.h"

namespace vitruvia::articulated {

class ArticulatedTracker : public Tracker {
 public:
  ArticulatedTracker(const char* name, const CommonSettings& settings);
  ~ArticulatedTracker() override;

  // DataError if the subject's mesh, weights or skeleton are invalid.
  void Start(const Subject& subject, const PinholeCamera& camera) final;
  // Energies of the result: those of the data term, then that of the prior about the prediction.
  TrackResult TrackFrame(const DepthFrame& frame) final;

 private:
  struct Session;  // everything that depends on the subject and the camera
  struct Ending;

  // `body` is the subject decimated to fewer vertices; it outlives the term.
  virtual std::unique_ptr<DataTerm> MakeDataTerm(const Subject& subject, const ShapedBody& body,
                                                 const PinholeCamera& camera) const = 0;

  const char* name_;
  CommonSettings settings_;
  std::unique_ptr<Session> session_;
};

}  // namespace vitruvia::articulated
