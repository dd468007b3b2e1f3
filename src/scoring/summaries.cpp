#include "scoring/summaries.h"

#include <algorithm>
#include <cmath>

#include "body/skeleton.h"
#include "config/did_you_mean.h"
#include "math/statistics.h"
#include "scoring/joint_score.h"

namespace vitruvia {
namespace {

double ShareOf(const std::vector<double>& values, bool (*belongs)(double value, double level),
               double level) {
  const auto count = std::count_if(values.begin(), values.end(),
                                   [&](double value) { return belongs(value, level); });
  return static_cast<double>(count) / static_cast<double>(values.size());
}

double StatisticOf(const std::vector<double>& values, const FrameSummary& summary) {
  switch (summary.statistic) {
    case FrameStatistic::kMean:
      return Mean(values);
    case FrameStatistic::kMedian:
      return Quantile(values, 0.5);
    case FrameStatistic::kQuantile:
      return Quantile(values, summary.quantile);
    case FrameStatistic::kMinimum:
      return *std::min_element(values.begin(), values.end());
    case FrameStatistic::kMaximum:
      return *std::max_element(values.begin(), values.end());
    case FrameStatistic::kShareAbove:
      return ShareOf(
          values, [](double value, double level) { return value > level; }, summary.level);
    case FrameStatistic::kShareBelow:
      return ShareOf(
          values, [](double value, double level) { return value < level; }, summary.level);
  }
  return kAbsent;
}

// The series over the named joints only.
std::vector<double> OverJoints(const JointErrorsOfFrames& errors, const FrameSummary& summary) {
  std::vector<double> series;
  for (const std::vector<double>& of_frame : errors.errors_m) {
    std::vector<double> chosen;
    for (std::size_t j = 0; j < errors.joints.size(); ++j) {
      const bool wanted = std::find(summary.joints.begin(), summary.joints.end(),
                                    errors.joints[j]) != summary.joints.end();
      if (wanted && !std::isnan(of_frame[j])) chosen.push_back(of_frame[j]);
    }
    series.push_back(summary.series == "joint_error_max_m" ? MaximumOrAbsent(chosen)
                                                           : MeanOrAbsent(chosen));
  }
  return series;
}

std::vector<double> SeriesOf(const FrameSummary& summary, const SequenceReader& sequence,
                             const EstimateReader& estimate, const RunRecord& record) {
  if (!summary.joints.empty()) return OverJoints(FindJointErrors(sequence, estimate), summary);
  const auto found = record.frames.find(summary.series);
  return found == record.frames.end() ? std::vector<double>{} : found->second;
}

}  // namespace

std::string JointsProblem(const FrameSummary& summary) {
  for (const std::string& joint : summary.joints) {
    if (FindJoint(joint) >= 0) continue;
    std::vector<std::string> names;
    for (const BoneInfo& bone : Bones()) names.emplace_back(bone.joint);
    return fmt::format("summary {}: the skeleton has no joint \"{}\"{}", summary.name, joint,
                       DidYouMean(joint, names));
  }
  return "";
}

void AddSummaries(const SequenceReader& sequence, const EstimateReader& estimate,
                  const std::vector<FrameSummary>& summaries, RunRecord& record) {
  for (const FrameSummary& summary : summaries) {
    const std::vector<double> values = PresentValues(SeriesOf(summary, sequence, estimate, record));
    if (values.empty()) continue;
    record.summary["summary[" + summary.name + "]"] = StatisticOf(values, summary);
  }
}

}  // namespace vitruvia
