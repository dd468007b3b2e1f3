#include "core/worker_team.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

namespace vitruvia {
namespace {

TEST(WorkerTeam, VisitsEveryItemOnce) {
  for (const int threads : {1, 2, 3}) {
    WorkerTeam team(threads);
    EXPECT_EQ(team.threads(), threads);
    for (const int count : {0, 1, 7, 64, 1000}) {
      for (const int grain : {1, 8, 2000}) {
        std::vector<int> visits(count, 0);
        team.For(count, grain, [&](int begin, int end) {
          EXPECT_EQ(begin % grain, 0);
          EXPECT_LE(end - begin, grain);
          for (int i = begin; i < end; ++i) ++visits[i];
        });
        EXPECT_EQ(visits, std::vector<int>(count, 1)) << threads << " " << count << " " << grain;
      }
    }
  }
}

TEST(WorkerTeam, ChoosesRangesByTheCountAlone) {
  const auto begins = [](int count, int threads) {
    WorkerTeam team(threads);
    std::vector<int> begin_of(count, -1);
    team.For(count, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) begin_of[i] = begin;
    });
    return begin_of;
  };
  for (const int count : {0, 1, 5, 32, 33, 12345}) {
    const std::vector<int> alone = begins(count, 1);
    EXPECT_EQ(std::count(alone.begin(), alone.end(), -1), 0);
    EXPECT_LE((std::set<int>(alone.begin(), alone.end()).size()), 32u);
    EXPECT_EQ(begins(count, 2), alone);
    EXPECT_EQ(begins(count, 7), alone);
  }
}

TEST(WorkerTeam, SumsOfRangesDoNotDependOnTheNumberOfThreads) {
  const auto sum = [](int threads) {
    WorkerTeam team(threads);
    std::vector<float> parts(100, 0.0f);
    team.For(10000, 100, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) parts[begin / 100] += 1.0f / static_cast<float>(i + 1);
    });
    return std::accumulate(parts.begin(), parts.end(), 0.0f);
  };
  EXPECT_EQ(sum(1), sum(2));
  EXPECT_EQ(sum(1), sum(4));
}

TEST(WorkerTeam, CarriesOutManyShortLoops) {
  WorkerTeam team(2);
  std::vector<int> visits(16, 0);
  for (int loop = 0; loop < 2000; ++loop) {
    team.For(16, 1, [&](int begin, int) { ++visits[begin]; });
  }
  EXPECT_EQ(visits, std::vector<int>(16, 2000));
}

TEST(WorkerTeam, WakesUpForNothingAndAfterSleeping) {
  for (const int threads : {1, 2, 3}) {
    WorkerTeam team(threads);
    std::vector<int> visits(16, 0);
    for (int loop = 0; loop < 20; ++loop) {
      team.WakeUp();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));  // helpers fall asleep again
      team.For(16, 1, [&](int begin, int) { ++visits[begin]; });
    }
    EXPECT_EQ(visits, std::vector<int>(16, 20));
  }
}

TEST(WorkerTeam, ThrowsAgainWhatABodyThrewAndGoesOn) {
  WorkerTeam team(2);
  const auto fail = [&] {
    team.For(100, 1, [](int begin, int) {
      if (begin == 57) throw std::out_of_range("57");
    });
  };
  EXPECT_THROW(fail(), std::out_of_range);
  int sum = 0;
  team.For(3, 3, [&](int begin, int end) { sum += end - begin; });
  EXPECT_EQ(sum, 3);
}

TEST(WorkerTeam, RefusesNoThreadsAndNoGrain) {
  EXPECT_THROW(WorkerTeam(0), std::invalid_argument);
  WorkerTeam team(1);
  EXPECT_THROW(team.For(3, 0, [](int, int) {}), std::invalid_argument);
  EXPECT_THROW(team.For(-1, [](int, int) {}), std::invalid_argument);
}

}  // namespace
}  // namespace vitruvia
