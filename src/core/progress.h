// Progress of long work on standard error: a bar on a terminal, one line at the end elsewhere.
#pragma once

#include <string>

#include "core/timer.h"

namespace vitruvia {

class Progress {
 public:
  Progress(std::string label, int total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void Advance(int steps = 1);

 private:
  void Draw();

  std::string label_;
  int total_, done_ = 0;
  bool terminal_;
  Stopwatch watch_;
  double last_drawn_ms_ = -1e9;
};

// Requests that running work stops at its next call of ThrowIfInterrupted. Safe in a signal
// handler.
void RequestInterrupt();
// Throws Error(kInterrupted) after RequestInterrupt.
void ThrowIfInterrupted();

}  // namespace vitruvia
