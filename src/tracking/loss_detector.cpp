#include "tracking/loss_detector.h"

#include <algorithm>

#include <fmt/format.h>

namespace vitruvia {

// Low: too little of the model is confirmed, or much of the cloud is unexplained and the model is
// not fully confirmed either. An object before the body leaves much unexplained, too, but what is
// visible of the model is then confirmed.
bool LossDetector::IsBelow(double threshold, const Agreement& agreement) const {
  constexpr double kFullyConfirmed = 0.97;  // share of the usual level
  return agreement.presence() < threshold * usual_.presence() ||
         (agreement.score() < threshold * usual_.score() &&
          agreement.confirmed < kFullyConfirmed * usual_.confirmed);
}

void LossDetector::SetUsual(const Agreement& agreement) {
  usual_.explained = std::max(agreement.explained, settings_.least_usual);
  usual_.confirmed = std::max(agreement.confirmed, settings_.least_usual);
  usual_.visible_fraction_evaluated = agreement.visible_fraction_evaluated;
}

FrameVerdict LossDetector::Assess(const Agreement& agreement) {
  constexpr double kFollow = 0.05;  // share of a new agreement in the usual level
  const bool is_low = IsBelow(settings_.agreement_threshold, agreement);
  is_doubtful_ = !is_first_ && IsBelow(settings_.doubt_threshold, agreement);
  if (is_first_) {
    is_first_ = false;
    SetUsual(agreement);
    if (!is_low) return FrameVerdict::kAgrees;
    // Searches at once: waiting does not help if no better frame is expected.
    return settings_.patience > 0 ? FrameVerdict::kSearch : FrameVerdict::kDisagrees;
  }
  if (!is_low) {
    Agreement usual = usual_;
    const auto follow = [](double& level, double now) { level += kFollow * (now - level); };
    follow(usual.explained, agreement.explained);
    follow(usual.confirmed, agreement.confirmed);
    follow(usual.visible_fraction_evaluated, agreement.visible_fraction_evaluated);
    SetUsual(usual);
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
  is_doubtful_ = IsBelow(settings_.doubt_threshold, agreement);
  if (agreement.score() > usual_.score()) SetUsual(agreement);
}

bool IsClearlyBetter(const Agreement& found, const Agreement& current, double margin) {
  return found.score() > current.score() + margin && found.confirmed >= current.confirmed;
}

std::string LossDetector::MessageOf(const Agreement& agreement) const {
  return fmt::format("the frame confirms {:.0f} % of the model, usually {:.0f} %",
                     100.0 * agreement.presence(), 100.0 * usual_.presence());
}

}  // namespace vitruvia
