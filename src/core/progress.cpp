#include "core/progress.h"

#include <algorithm>
#include <atomic>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "core/message.h"

namespace vitruvia {
namespace {
constexpr double kRedrawEveryMs = 100.0;
constexpr int kBarWidth = 30;
std::atomic<bool> interrupt_requested{false};
}  // namespace

Progress::Progress(std::string label, int total)
    : label_(std::move(label)), total_(std::max(total, 1)), terminal_(isatty(STDERR_FILENO) != 0) {
  if (terminal_) Draw();
}

Progress::~Progress() {
  if (terminal_) {
    Draw();
    WriteMessage("");  // ends the bar's line
  } else {
    PrintMessage("{}: {}/{} in {:.1f} s\n", label_, done_, total_, watch_.ElapsedMs() / 1e3);
  }
}

void Progress::Advance(int steps) {
  done_ += steps;
  if (terminal_ && watch_.ElapsedMs() - last_drawn_ms_ >= kRedrawEveryMs) Draw();
  ThrowIfInterrupted();
}

void Progress::Draw() {
  last_drawn_ms_ = watch_.ElapsedMs();
  const int filled = std::min(kBarWidth, kBarWidth * done_ / total_);
  DrawBar(fmt::format("{:<40.40} [{:<{}}] {}/{} {:.0f} s ", label_, std::string(filled, '#'),
                      kBarWidth, done_, total_, last_drawn_ms_ / 1e3));
}

void RequestInterrupt() { interrupt_requested = true; }

void ThrowIfInterrupted() {
  if (interrupt_requested) throw Error(ExitCode::kInterrupted, "interrupted");
}

}  // namespace vitruvia
