#include "core/worker_team.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/error.h"

namespace vitruvia {
namespace {

// How long a helper looks for the next loop before it sleeps: between two loops of a frame less
// passes. And the caller for the end of the last ranges: a longer wait means that a helper has lost
// its core, which the caller gives to it by sleeping.
constexpr std::chrono::microseconds kLookForLoop{500}, kLookForEnd{100};
constexpr int kLooksBetweenYields = 64;

void Pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

// Returns when the number is no longer `old`. Other programs may take the processor meanwhile.
template <class Number>
void WaitForChange(const std::atomic<Number>& number, Number old,
                   std::chrono::microseconds longest_look) {
  const auto end = std::chrono::steady_clock::now() + longest_look;
  do {
    for (int look = 0; look < kLooksBetweenYields; ++look) {
      if (number != old) return;
      Pause();
    }
    std::this_thread::yield();
  } while (std::chrono::steady_clock::now() < end);
  number.wait(old);
}

}  // namespace

WorkerTeam::WorkerTeam(int threads) {
  Require(threads >= 1, "WorkerTeam of {} threads, expected 1 or more", threads);
  for (int i = 1; i < threads; ++i) helpers_.emplace_back([this] { Help(); });
}

WorkerTeam::~WorkerTeam() {
  stop_ = true;
  Notify();
  for (std::thread& helper : helpers_) helper.join();
}

void WorkerTeam::WakeUp() {
  if (!helpers_.empty()) Notify();
}

void WorkerTeam::Notify() {
  ++generation_;
  generation_.notify_all();
}

void WorkerTeam::Run(int count, int grain, const void* body, Call call) {
  Require(count >= 0 && grain >= 1, "WorkerTeam::For: {} items in ranges of {}", count, grain);
  if (helpers_.empty() || count <= grain) {
    for (int begin = 0; begin < count; begin += grain) {
      call(body, begin, std::min(begin + grain, count));
    }
    return;
  }
  body_ = body;
  call_ = call;
  count_ = count;
  grain_ = grain;
  next_ = 0;
  helpers_inside_ = 0;
  Notify();
  TakeRanges();
  int inside = helpers_inside_.fetch_or(kClosed) | kClosed;
  for (; inside != kClosed; inside = helpers_inside_)
    WaitForChange(helpers_inside_, inside, kLookForEnd);
  if (problem_) std::rethrow_exception(std::exchange(problem_, nullptr));
}

void WorkerTeam::Help() {
  unsigned seen = 0;
  while (true) {
    WaitForChange(generation_, seen, kLookForLoop);
    seen = generation_;
    if (stop_) return;
    if (!Enter()) continue;
    TakeRanges();
    --helpers_inside_;
    helpers_inside_.notify_one();
  }
}

bool WorkerTeam::Enter() {
  int inside = helpers_inside_;
  while (inside < kClosed) {
    if (helpers_inside_.compare_exchange_weak(inside, inside + 1)) return true;
  }
  return false;
}

void WorkerTeam::TakeRanges() {
  for (int begin = next_.fetch_add(grain_); begin < count_; begin = next_.fetch_add(grain_)) {
    try {
      call_(body_, begin, std::min(begin + grain_, count_));
    } catch (...) {
      const std::lock_guard lock(problem_mutex_);
      problem_ = std::current_exception();
    }
  }
}

}  // namespace vitruvia
