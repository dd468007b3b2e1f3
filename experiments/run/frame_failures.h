// The number of a run's failed frames, and whether there are too many.
#pragma once

#include <string>

#include "config/json_settings.h"

namespace vitruvia {

struct FrameFailures {
  int failed = 0, frames = 0;

  bool AreAll() const { return frames > 0 && failed == frames; }
  bool AreMoreThan(double limit) const { return failed > limit * frames; }
  // "8 of 12 frames failed, more than the limit of 50 %".
  std::string Text(double limit) const;
};

// Read from a run record's summary; zero for a run without frames.
FrameFailures FrameFailuresOf(const Json& summary);

}  // namespace vitruvia
