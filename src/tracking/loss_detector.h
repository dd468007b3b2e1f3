// Detects that a subject is lost, frame by frame.
#pragma once

#include <string>

#include "tracking/agreement.h"
#include "tracking/relocalization_settings.h"

namespace vitruvia {

enum class FrameVerdict {
  kAgrees,     // the pose can be trusted
  kDisagrees,  // agreement is low
  kSearch,     // agreement is low, and other poses should be searched now
};

// Learns the usual agreement of a subject and compares each frame with it.
class LossDetector {
 public:
  explicit LossDetector(const RelocalizationSettings& settings) : settings_(settings) {}

  // To be called once for each frame with measurements. kSearch: agreement has been low for
  // `patience` frames, empty ones included, or is already low in the first frame. The agreement of
  // the first frame becomes the usual level.
  FrameVerdict Assess(const Agreement& agreement);
  void NoteEmptyFrame() { ++num_low_; }
  // To be called after the pose of a search, with this agreement, was adopted.
  void NoteFound(const Agreement& agreement);

  bool is_lost() const { return num_low_ > 0 || is_doubtful_; }
  const Agreement& usual() const { return usual_; }
  // Why a frame of this agreement is lost.
  std::string MessageOf(const Agreement& agreement) const;

 private:
  bool IsBelow(double threshold, const Agreement& agreement) const;
  void SetUsual(const Agreement& agreement);

  RelocalizationSettings settings_;
  Agreement usual_{1.0, 1.0, 1.0};
  bool is_first_ = true;
  bool is_doubtful_ = false;
  int num_low_ = 0;              // consecutive frames
  int frames_until_search_ = 0;  // minimum number of frames until the next search
};

// Whether the pose with agreement `found` should replace the current one: its score must be higher
// by `margin`, and its confirmed share must not be smaller, so that an object that hides the body
// is not mistaken for it.
bool IsClearlyBetter(const Agreement& found, const Agreement& current, double margin);

}  // namespace vitruvia
