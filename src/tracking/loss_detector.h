// Detects from frame to frame that a subject is lost.
#pragma once

#include "tracking/agreement.h"
#include "tracking/relocalization_settings.h"

namespace vitruvia {

enum class FrameVerdict {
  kAgrees,     // the pose can be trusted
  kDisagrees,  // agreement is low
  kSearch,     // agreement is low, and other poses should be searched now
};

// Learns the usual level of agreement and compares each frame with it.
class LossDetector {
 public:
  explicit LossDetector(const RelocalizationSettings& settings) : settings_(settings) {}

  // To be called once for each frame with measurements. kSearch: agreement has been low for
  // `patience` frames, empty ones included, or is low in the first frame already; what the first
  // frame reaches becomes the usual level.
  FrameVerdict Assess(const Agreement& agreement);
  void NoteEmptyFrame() { ++num_low_; }
  // A search found a pose with this agreement, and its pose was taken.
  void NoteFound(const Agreement& agreement);

  bool is_lost() const { return num_low_ > 0 || is_doubtful_; }
  const Agreement& usual() const { return usual_; }

 private:
  bool IsBelow(double threshold, const Agreement& agreement) const;
  void SetUsual(const Agreement& agreement);

  RelocalizationSettings settings_;
  Agreement usual_{1.0, 1.0, 1.0};
  bool is_first_ = true;
  bool is_doubtful_ = false;
  int num_low_ = 0;              // consecutive frames
  int frames_until_search_ = 0;  // at the earliest
};

// Whether the pose with agreement `found` should replace the current one: its score is higher by
// `margin`, and no smaller share of the model is confirmed, so that an object that hides the body
// is not taken for it.
bool IsClearlyBetter(const Agreement& found, const Agreement& current, double margin);

}  // namespace vitruvia
