#include "metrics/limb_recovery.h"

#include <string>

#include <gtest/gtest.h>

namespace vitruvia {
namespace {

// One letter a frame: '.' tracked, 'v' lost and visible, 'h' lost and hidden.
LimbRecoveries Count(const std::string& frames, int allowed_frames) {
  std::vector<LimbState> states;
  for (const char letter : frames) states.push_back({letter != '.', letter != 'h'});
  return CountRecoveries(states, allowed_frames);
}

TEST(LimbRecovery, OnlyFramesInWhichTheLimbIsSeenCount) {
  const LimbRecoveries found = Count(".hhhhhvv..vvv.", 2);  // 2 and 3 visible frames
  EXPECT_EQ(found.losses, 2);
  EXPECT_EQ(found.in_time, 1);
  EXPECT_EQ(found.undecided, 0);
  EXPECT_EQ(Count(".vhv.", 2).in_time, 1) << "a limb that hides in between goes on being lost";
  EXPECT_EQ(Count(".vhvv.", 2).in_time, 0);
}

TEST(LimbRecovery, ALimbThatIsNeverSeenIsNoCase) {
  const LimbRecoveries hidden = Count("hhhh..hhhh", 2);
  EXPECT_EQ(hidden.losses, 0);
  EXPECT_EQ(hidden.undecided, 0);
}

TEST(LimbRecovery, TheEndOfTheRunDecidesOnlyWhatIsTooLateAlready) {
  const LimbRecoveries early = Count("..hvv", 2);
  EXPECT_EQ(early.losses, 0);
  EXPECT_EQ(early.undecided, 1);
  const LimbRecoveries late = Count("..hvvv", 2);
  EXPECT_EQ(late.losses, 1);
  EXPECT_EQ(late.in_time, 0);
  EXPECT_EQ(late.undecided, 0);
}

}  // namespace
}  // namespace vitruvia
