// A frame of Realtime SCAPE takes no memory but that of its result: buffers are kept.
#include <atomic>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include "math/rigid.h"
#include "methods/realtime_scape/realtime_scape.h"
#include "support/arm_stage.h"

namespace {

std::atomic<long> num_allocations = 0;

// The address sanitizer's own operators know which memory they gave, and refuse what others freed.
#ifdef __SANITIZE_ADDRESS__
constexpr bool kCountsAllocations = false;
#else
constexpr bool kCountsAllocations = true;
#endif

[[maybe_unused]] void* Counted(void* memory) {
  ++num_allocations;
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

#ifndef __SANITIZE_ADDRESS__
// Not inlined, so that the compiler does not take one of a pair for mismatched.
[[gnu::noinline]] void* operator new(std::size_t size) { return Counted(std::malloc(size)); }
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto unit = static_cast<std::size_t>(alignment);
  return Counted(std::aligned_alloc(unit, (size + unit - 1) / unit * unit));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
#endif

namespace vitruvia::realtime_scape {
namespace {

TEST(RealtimeScapeMemory, AFrameAllocatesItsResultAlone) {
  if (!kCountsAllocations)
    GTEST_SKIP() << "allocations are not counted under the address sanitizer";
  const Rigidd camera_from_subject{Vector3d(1, -1, -1).asDiagonal(), {0.05, 0.9, 2.8}};
  ArmStage stage(1, SkinLinear, camera_from_subject);
  RealtimeScape tracker{Settings{}};
  tracker.Start(stage.body, stage.camera);
  constexpr int kFramesToGrow = 12;
  for (int i = 0; i < kFramesToGrow + 8; ++i) {
    const DepthFrame frame = stage.Frame(i, 0.04 * i);
    const long before = num_allocations;
    const TrackResult result = tracker.TrackFrame(frame);
    const long taken = num_allocations - before;
    ASSERT_FALSE(IsFailure(result.outcome));
    // Its vertices, bones, joints, energies and times.
    if (i >= kFramesToGrow) {
      EXPECT_EQ(taken, 5) << "frame " << i;
    }
  }
}

}  // namespace
}  // namespace vitruvia::realtime_scape
