#include "tracking/step_clock.h"

#include <gtest/gtest.h>

#include "tracking/frame_checks.h"
#include "tracking/realtime_scape_steps.h"

namespace vitruvia {
namespace {

enum class Step { kFirst, kSecond, kCount };
const char* Name(Step step) { return step == Step::kFirst ? "first" : "second"; }

// Each lap takes one millisecond more than the one before.
struct FakeWatch {
  double LapMs() { return ++lap; }
  double lap = 0.0;
};

TEST(StepClock, BooksLapsUnderStepsAndLeavesOutWhatIsSkipped) {
  StepClock<Step, FakeWatch> clock;
  clock.Restart();           // 1
  clock.Lap(Step::kFirst);   // 2
  clock.Lap(Step::kSecond);  // 3
  clock.Skip();              // 4
  clock.Lap(Step::kFirst);   // 5
  StepTimes<Step> times = clock.times();
  EXPECT_EQ(times[Step::kFirst], 7.0);
  EXPECT_EQ(times[Step::kSecond], 3.0);
  times += times;
  const std::vector<NamedValue> named = times.Named();
  ASSERT_EQ(named.size(), 2u);
  EXPECT_EQ(named[0].name, "first");
  EXPECT_EQ(named[0].value, 14.0);
  EXPECT_EQ(named[1].name, "second");
  clock.Restart();
  EXPECT_EQ(clock.times()[Step::kFirst], 0.0);
}

TEST(RealtimeScapeStep, EveryStepHasANameOfItsOwn) {
  const std::vector<NamedValue> steps = StepTimes<RealtimeScapeStep>().Named();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_NE(steps[i].name, "");
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(steps[i].name, steps[k].name);
  }
}

TEST(CheckFrameSize, NamesTheFrameAndBothSizes) {
  const PinholeCamera camera{
      .width = 320, .height = 240, .fx = 300, .fy = 300, .cx = 160, .cy = 120};
  CheckFrameSize({7, 0.0, DepthImage(320, 240)}, camera);
  try {
    CheckFrameSize({7, 0.0, DepthImage(240, 320)}, camera);
    FAIL() << "the frame was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "frame 7 is 240×320 pixels, the camera 320×240");
  }
}

}  // namespace
}  // namespace vitruvia
