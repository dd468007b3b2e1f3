#include "experiments/run/frame_failures.h"

#include <fmt/format.h>

namespace vitruvia {

std::string FrameFailures::Text(double limit) const {
  return fmt::format("{} of {} frames failed, more than the limit of {:.3g} %", failed, frames,
                     100.0 * limit);
}

FrameFailures FrameFailuresOf(const Json& summary) {
  return {summary.value("frames_failed", 0), summary.value("frames", 0)};
}

}  // namespace vitruvia
