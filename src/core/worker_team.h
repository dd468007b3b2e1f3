// A thread pool for loops so short that starting threads would cost more than the work.
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace vitruvia {

// Runs loops on a fixed number of threads, the caller's included. A team belongs to one caller at a
// time.
//
// A sleeping thread takes longer to wake up than a short loop takes. Helpers therefore look for the
// next loop for half a millisecond before they sleep without using the processor.
class WorkerTeam {
 public:
  explicit WorkerTeam(int threads);  // ≥ 1
  ~WorkerTeam();
  WorkerTeam(const WorkerTeam&) = delete;
  WorkerTeam& operator=(const WorkerTeam&) = delete;

  int threads() const { return static_cast<int>(helpers_.size()) + 1; }

  // Wakes up helpers that sleep, for a loop that follows soon.
  void WakeUp();

  // Calls body(begin, end) for the ranges 0 … grain, grain … 2·grain, … of 0 … count, each once, in
  // any order and on any thread. The ranges depend on count and grain alone: a sum is the same for
  // any number of threads if each range keeps its own part and the parts are added in order. No
  // memory is allocated. If bodies throw, one of their exceptions is rethrown here, after all other
  // ranges have run.
  template <class Body>
  void For(int count, int grain, const Body& body) {
    Run(count, grain, &body, [](const void* erased, int begin, int end) {
      (*static_cast<const Body*>(erased))(begin, end);
    });
  }

  // The same in at most kRanges ranges: enough that threads of unequal speed finish together, and
  // few enough that the overhead of a range is small.
  template <class Body>
  void For(int count, const Body& body) {
    For(count, std::max(1, (count + kRanges - 1) / kRanges), body);
  }

 private:
  static constexpr int kRanges = 32;
  using Call = void (*)(const void* body, int begin, int end);

  void Notify();
  void Run(int count, int grain, const void* body, Call call);
  void Help();
  bool Enter();
  void TakeRanges();

  // The current loop: written only while no helper is inside.
  const void* body_ = nullptr;
  Call call_ = nullptr;
  int count_ = 0, grain_ = 1;
  std::atomic<int> next_{0};  // begin of the next range to be taken
  // Helpers in the loop, plus kClosed while none may enter. The caller closes a loop when all its
  // ranges are taken, so it does not wait for a helper that arrives late because its core was busy.
  static constexpr int kClosed = 1 << 16;
  std::atomic<int> helpers_inside_{kClosed};
  std::atomic<unsigned> generation_{0};
  std::atomic<bool> stop_{false};
  std::mutex problem_mutex_;
  std::exception_ptr problem_;
  std::vector<std::thread> helpers_;
};

}  // namespace vitruvia
