// Threads that stay: for loops so short that starting a thread would cost more than the work.
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace vitruvia {

// Runs loops on a fixed number of threads, the caller's included. Threads wait between loops
// without using the processor. A team belongs to one caller at a time.
class WorkerTeam {
 public:
  explicit WorkerTeam(int threads);  // ≥ 1
  ~WorkerTeam();
  WorkerTeam(const WorkerTeam&) = delete;
  WorkerTeam& operator=(const WorkerTeam&) = delete;

  int threads() const { return static_cast<int>(helpers_.size()) + 1; }

  // Calls body(begin, end) for the ranges 0 … grain, grain … 2·grain, … of 0 … count, each once, in
  // any order and on any thread. The ranges depend on count and grain alone: a sum is the same for
  // any number of threads if each range keeps its own part and the parts are added in order. No
  // memory is allocated. An exception of a body is thrown again here, one of them if there are
  // several; the other ranges are carried out all the same.
  template <class Body>
  void For(int count, int grain, const Body& body) {
    Run(count, grain, &body, [](const void* erased, int begin, int end) {
      (*static_cast<const Body*>(erased))(begin, end);
    });
  }

  // The same in at most kRanges ranges: so many that threads of unequal speed finish together, so
  // few that a range is worth its start.
  template <class Body>
  void For(int count, const Body& body) {
    For(count, std::max(1, (count + kRanges - 1) / kRanges), body);
  }

 private:
  static constexpr int kRanges = 32;
  using Call = void (*)(const void* body, int begin, int end);

  void Run(int count, int grain, const void* body, Call call);
  void Help();
  bool Enter();
  void TakeRanges();

  // The loop at hand: written while no helper is in it.
  const void* body_ = nullptr;
  Call call_ = nullptr;
  int count_ = 0, grain_ = 1;
  std::atomic<int> next_{0};  // begin of the next range to be taken
  // Helpers in the loop, plus kClosed while none may enter. The caller closes a loop when all its
  // ranges are taken, so a helper that comes late, its core being busy elsewhere, is not waited
  // for.
  static constexpr int kClosed = 1 << 16;
  std::atomic<int> helpers_inside_{kClosed};
  std::atomic<unsigned> generation_{0};
  std::atomic<bool> stop_{false};
  std::mutex problem_mutex_;
  std::exception_ptr problem_;
  std::vector<std::thread> helpers_;
};

}  // namespace vitruvia
