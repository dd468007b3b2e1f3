#include "tracking/search_pause.h"

#include <vector>

#include <gtest/gtest.h>

namespace vitruvia {
namespace {

// The frames with a search that finds nothing.
std::vector<int> Searches(SearchPause pause, int frames) {
  std::vector<int> searches;
  for (int frame = 0; frame < frames; ++frame) {
    pause.NextFrame();
    if (!pause.is_over()) continue;
    searches.push_back(frame);
    pause.Begin();
  }
  return searches;
}

TEST(SearchPause, DoublesWithEachSearch) {
  EXPECT_EQ(Searches(SearchPause(2), 20), (std::vector<int>{0, 2, 6, 14}));
}

TEST(SearchPause, IsTheLeastAgainAfterAReset) {
  SearchPause pause(3);
  pause.Begin();
  pause.Begin();
  pause.Reset();
  EXPECT_EQ(Searches(pause, 10), (std::vector<int>{0, 3, 9}));
}

}  // namespace
}  // namespace vitruvia
