#include "core/parallel.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <exception>
#include <thread>
#include <vector>

#include "core/error.h"

namespace vitruvia {
namespace {

// So many that threads of unequal speed finish together, so few that a range is worth its start.
constexpr int kRanges = 32;

int RangeBegin(int range, int ranges, int count) {
  return static_cast<int>(static_cast<std::int64_t>(count) * range / ranges);
}

}  // namespace

void ParallelFor(int count, int threads, const std::function<void(int begin, int end)>& body) {
  Require(count >= 0 && threads >= 1, "ParallelFor: {} items on {} threads", count, threads);
  const int ranges = std::min(count, kRanges);
  std::array<std::exception_ptr, kRanges> problems{};
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int range = next++; range < ranges; range = next++) {
      try {
        body(RangeBegin(range, ranges, count), RangeBegin(range + 1, ranges, count));
      } catch (...) {
        problems[static_cast<std::size_t>(range)] = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (int i = 1; i < std::min(threads, ranges); ++i) helpers.emplace_back(work);
    work();
  }
  for (const std::exception_ptr& problem : problems) {
    if (problem) std::rethrow_exception(problem);
  }
}

}  // namespace vitruvia
