#include "tracking/loss_detector.h"

#include <algorithm>

namespace vitruvia {

// Low: too little of the model is confirmed, or much of the cloud is unexplained and the model is
// not fully confirmed either. An object before the body leaves much unexplained, too, but what is
// visible of the model is then confirmed.
bool LossDetector::IsLow(const Agreement& agreement) const {
  constexpr double kFullyConfirmed = 0.97;  // share of the usual level
  const double threshold = settings_.agreement_threshold;
  return agreement.presence() < threshold * usual_.presence() ||
         (agreement.score() < threshold * usual_.score() &&
          agreement.confirmed < kFullyConfirmed * usual_.confirmed);
}

FrameVerdict LossDetector::Assess(const Agreement& agreement) {
  constexpr double kFollow = 0.05;  // share of a new agreement in the usual level
  const bool is_low = IsLow(agreement);
  if (is_first_) {
    is_first_ = false;
    usual_ = agreement;
    if (!is_low) return FrameVerdict::kAgrees;
    // No better frame is to be expected, so patience does not help.
    return settings_.patience > 0 ? FrameVerdict::kSearch : FrameVerdict::kDisagrees;
  }
  if (!is_low) {
    const auto follow = [](double& usual, double now) { usual += kFollow * (now - usual); };
    follow(usual_.explained, agreement.explained);
    follow(usual_.confirmed, agreement.confirmed);
    follow(usual_.visible_fraction_evaluated, agreement.visible_fraction_evaluated);
    num_low_ = 0;
    return FrameVerdict::kAgrees;
  }
  ++num_low_;
  if (settings_.patience == 0 || num_low_ < settings_.patience || frames_until_search_ > 0) {
    frames_until_search_ = std::max(frames_until_search_ - 1, 0);
    return FrameVerdict::kDisagrees;
  }
  frames_until_search_ = settings_.pause - 1;
  return FrameVerdict::kSearch;
}

void LossDetector::NoteFound(const Agreement& agreement) {
  num_low_ = 0;
  if (agreement.score() > usual_.score()) usual_ = agreement;
}

bool IsClearlyBetter(const Agreement& found, const Agreement& current, double margin) {
  return found.score() > current.score() + margin && found.confirmed >= current.confirmed;
}

}  // namespace vitruvia
