#include "records/metric_value.h"

namespace vitruvia {
namespace {

double MemberNumber(const nlohmann::json& object, const std::string& key) {
  if (!object.is_object()) return kAbsent;
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : kAbsent;
}

double StepTime(const RunRecord& run, const std::string& step, double RunRecord::Step::*time_ms) {
  for (const RunRecord::Step& candidate : run.steps) {
    if (candidate.name == step) return candidate.*time_ms;
  }
  return kAbsent;
}

double FamilyValue(const RunRecord& run, const Metric& metric) {
  if (metric.family == kStepMedian)
    return StepTime(run, metric.member, &RunRecord::Step::median_ms);
  if (metric.family == kStepP95) return StepTime(run, metric.member, &RunRecord::Step::p95_ms);
  if (metric.family == kStepMax) return StepTime(run, metric.member, &RunRecord::Step::max_ms);
  if (metric.family == kOwnSummary) return MemberNumber(run.summary, metric.key);
  if (metric.family == kJointErrorOfJoint) {
    const auto found = run.joint_error_mean_m.find(metric.member);
    if (found != run.joint_error_mean_m.end()) return found->second;
  }
  return kAbsent;  // energies of terms are stored per frame only
}

}  // namespace

double CalibrationOf(const RunRecord& run) {
  return MemberNumber(run.provenance, "calibration_ms");
}

double MetricValue(const RunRecord& run, const Metric& metric) {
  if (!metric.family.empty()) return FamilyValue(run, metric);
  if (metric.key == kCalibratedTime)
    return MemberNumber(run.summary, "frame_ms_median") / CalibrationOf(run);
  return MemberNumber(run.summary, metric.key);
}

double MetricValue(const RunRecord& run, const std::string& key) {
  return MetricValue(run, FindMetric(key));
}

int RepeatOf(const RunRecord& run) {
  return run.summary.is_object() ? run.summary.value("repeat", 1) : 1;
}

}  // namespace vitruvia
