// Summaries that an experiment defines itself: one number of a run from a series over its frames.
#pragma once

#include <string>
#include <vector>

#include "config/settings.h"

namespace vitruvia {

enum class FrameStatistic {
  kMean,
  kMedian,
  kQuantile,
  kMinimum,
  kMaximum,
  kShareAbove,
  kShareBelow
};

struct FrameSummary {
  std::string name;    // stored as the metric "summary[NAME]"
  std::string series;  // of the record, over the frames
  // Only for joint_error_mean_m and joint_error_max_m: restricts the mean and the maximum to these
  // joints.
  std::vector<std::string> joints;
  FrameStatistic statistic = FrameStatistic::kMean;
  double quantile = 0.9;
  double level = 0.0;

  void Describe(Fields& fields);
  std::string Problem() const;
};

}  // namespace vitruvia
