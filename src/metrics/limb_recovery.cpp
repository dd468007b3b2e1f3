#include "metrics/limb_recovery.h"

namespace vitruvia {

LimbRecoveries CountRecoveries(const std::vector<LimbState>& frames, int allowed_frames) {
  LimbRecoveries recoveries;
  const auto end_loss = [&](int visible_frames, bool is_found) {
    if (visible_frames == 0) return;
    if (!is_found && visible_frames <= allowed_frames) {
      ++recoveries.undecided;
      return;
    }
    ++recoveries.losses;
    if (visible_frames <= allowed_frames) ++recoveries.in_time;
  };
  int visible_frames = 0;
  for (const LimbState& frame : frames) {
    if (frame.is_lost) {
      visible_frames += frame.is_visible ? 1 : 0;
      continue;
    }
    end_loss(visible_frames, true);
    visible_frames = 0;
  }
  end_loss(visible_frames, false);
  return recoveries;
}

}  // namespace vitruvia
