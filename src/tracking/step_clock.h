// Times the steps of a frame.
#pragma once

#include <array>
#include <vector>

#include "core/timer.h"
#include "tracking/tracker.h"

namespace vitruvia {

// Milliseconds of each step. Step is an enum class whose last enumerator is kCount; `Name(Step)`
// gives a step's name in results.
template <class Step>
class StepTimes {
 public:
  double& operator[](Step step) { return ms_[static_cast<std::size_t>(step)]; }
  double operator[](Step step) const { return ms_[static_cast<std::size_t>(step)]; }
  StepTimes& operator+=(const StepTimes& other) {
    for (std::size_t k = 0; k < kCount; ++k) ms_[k] += other.ms_[k];
    return *this;
  }
  // In the order of the enum.
  std::vector<NamedValue> Named() const {
    std::vector<NamedValue> values;
    values.reserve(kCount);
    for (std::size_t k = 0; k < kCount; ++k) {
      values.push_back({Name(static_cast<Step>(k)), ms_[k]});
    }
    return values;
  }

 private:
  static constexpr auto kCount = static_cast<std::size_t>(Step::kCount);
  std::array<double, kCount> ms_{};
};

// A stopwatch that adds each lap to a step. `Watch` has a member `double LapMs()`.
template <class Step, class Watch = Stopwatch>
class StepClock {
 public:
  explicit StepClock(Watch watch = {}) : watch_(watch) {}

  // Resets all times to zero and begins the first lap.
  void Restart() {
    times_ = {};
    watch_.LapMs();
  }
  // Adds the time since the end of the last lap to this step's.
  void Lap(Step step) { times_[step] += watch_.LapMs(); }
  // Ends a lap without adding it to a step.
  void Skip() { watch_.LapMs(); }

  const StepTimes<Step>& times() const { return times_; }

 private:
  StepTimes<Step> times_;
  Watch watch_;
};

}  // namespace vitruvia
