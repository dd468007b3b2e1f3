#include "records/metric_value.h"

namespace vitruvia {
namespace {

double MemberNumber(const nlohmann::json& object, const std::string& key) {
  if (!object.is_object()) return kAbsent;
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : kAbsent;
}

}  // namespace

double CalibrationOf(const RunRecord& run) {
  return MemberNumber(run.provenance, "calibration_ms");
}

double MetricValue(const RunRecord& run, const std::string& key) {
  if (key == kCalibratedTime)
    return MemberNumber(run.summary, "frame_ms_median") / CalibrationOf(run);
  return MemberNumber(run.summary, key);
}

bool HigherIsBetter(const std::string& key) { return key.find("within") != std::string::npos; }

}  // namespace vitruvia
