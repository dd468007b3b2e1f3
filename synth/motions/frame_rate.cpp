#include "synth/motions/frame_rate.h"

#include <cmath>

#include <fmt/format.h>

namespace vitruvia {
namespace {

constexpr double kFastest = 2000.0;  // frames/s of any capture system
constexpr double kSlowestS = 1.0;    // between frames
constexpr double kSlowS = 0.2;       // a capture system has at least 5 frames/s
constexpr double kCommonSlowest = 5.0, kCommonFastest = 1000.0;  // frames/s

bool IsCommonRate(double fps) { return fps >= kCommonSlowest && fps <= kCommonFastest; }

std::string LikelyCause(double frame_s) {
  const bool is_rate = IsCommonRate(frame_s) && frame_s == std::round(frame_s);
  if (is_rate) {
    return fmt::format(": frames per second? {:g} frames/s is a frame time of {:.7f}", frame_s,
                       1.0 / frame_s);
  }
  if (IsCommonRate(1e3 / frame_s)) {
    return fmt::format(": milliseconds? {:g} ms is {:.4g} frames/s", frame_s, 1e3 / frame_s);
  }
  if (IsCommonRate(1e6 / frame_s)) {
    return fmt::format(": microseconds? {:g} µs is {:.4g} frames/s", frame_s, 1e6 / frame_s);
  }
  return ": the unit is not seconds, or the number is damaged";
}

}  // namespace

std::string FrameTimeProblem(double frame_s) {
  const std::string range =
      fmt::format("expected above 0, {:g} … {:g} s, got {:g}", 1.0 / kFastest, kSlowestS, frame_s);
  if (!(frame_s > 0.0)) return range + ": the rate was not known when the file was written?";
  if (frame_s > kSlowestS) return range + LikelyCause(frame_s);
  if (frame_s < 1.0 / kFastest) {
    return range + fmt::format(": {:g} frames/s, which no capture system has", 1.0 / frame_s);
  }
  return "";
}

std::string FrameTimeDoubt(double frame_s) {
  if (frame_s <= kSlowS) return "";
  return fmt::format("{:g} s is {:.3g} frames/s; capture systems have {:g} and more", frame_s,
                     1.0 / frame_s, kCommonSlowest);
}

}  // namespace vitruvia
