#include "core/process_memory.h"

#include <vector>

#include <gtest/gtest.h>

namespace vitruvia {
namespace {

TEST(ProcessMemory, PeakHoldsWhatWasGivenBackUntilForgotten) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer keeps what is given back";
#endif
  constexpr std::size_t kBytes = 80'000'000;  // so large that it goes back to the system
  constexpr double kTolerance_mb = 4.0;
  ForgetPeakMemory();
  const double before_mb = ResidentMemory_mb();
  { const std::vector<char> given_back(kBytes, 1); }
  EXPECT_NEAR(PeakMemory_mb(), before_mb + 80.0, kTolerance_mb);
  EXPECT_NEAR(ResidentMemory_mb(), before_mb, kTolerance_mb);
  ForgetPeakMemory();
  EXPECT_NEAR(PeakMemory_mb(), before_mb, kTolerance_mb);
}

}  // namespace
}  // namespace vitruvia
