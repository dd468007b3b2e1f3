// Progress of long work: a bar where standard error is a terminal, one line at the end elsewhere.
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

// Asks running work to stop at its next safe point (set by a signal handler).
void RequestInterrupt();
// Throws Error(kInterrupted) if a stop was asked for.
void ThrowIfInterrupted();

}  // namespace vitruvia
