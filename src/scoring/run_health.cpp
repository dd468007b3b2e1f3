#include "scoring/run_health.h"

#include <algorithm>
#include <cmath>

#include "math/statistics.h"
#include "metrics/catalogue.h"

namespace vitruvia {
namespace {

// A frame is lost when the tracker says so, or when the mean error of the visible surface exceeds
// this.
constexpr double kLostAbove_m = 0.05;

enum class FrameState { kTracked, kLost, kUnknown };

// If nothing of the surface is visible, its error is absent and the state is unknown.
FrameState StateOf(double failed, double visible_error_m) {
  if (failed > 0.0) return FrameState::kLost;
  if (std::isnan(visible_error_m)) return FrameState::kUnknown;
  return visible_error_m > kLostAbove_m ? FrameState::kLost : FrameState::kTracked;
}

// frames_lost: lost frames. frames_to_recover: the most lost frames between two tracked ones; -1 if
// the subject was not found again before the end. frames_to_notice: the longest run of lost frames
// that the tracker does not report. All of them only with a true surface.
void SummarizeLosses(const RunRecord& record, nlohmann::json& row) {
  const bool corresponding = record.frames.contains("l2_mean_visible_m");
  if (!corresponding && !record.frames.contains("two_way_visible_mean_m")) return;
  const auto& failed = record.frames.at("failed");
  const auto& error_m =
      record.frames.at(corresponding ? "l2_mean_visible_m" : "two_way_visible_mean_m");
  int lost = 0, run = 0, longest = 0, untold = 0, longest_untold = 0;
  for (std::size_t i = 0; i < failed.size(); ++i) {
    const FrameState state = StateOf(failed[i], error_m[i]);
    if (state == FrameState::kLost) ++lost, ++run;
    if (state == FrameState::kTracked) run = 0;
    longest = std::max(longest, run);
    untold = state == FrameState::kLost && failed[i] == 0.0 ? untold + 1 : 0;
    longest_untold = std::max(longest_untold, untold);
  }
  row["frames_lost"] = lost;
  row["frames_to_recover"] = run > 0 ? -1 : longest;
  row["frames_to_notice"] = longest_untold;
}

// Infinite numbers of all frames. NaN says that a value is absent and does not count; a tracker's
// NaN cannot get here, since estimates refuse it.
int CountInfinite(const RunRecord& record) {
  int count = 0;
  for (const auto& [name, values] : record.frames) {
    count += static_cast<int>(
        std::count_if(values.begin(), values.end(), [](double v) { return std::isinf(v); }));
  }
  return count;
}

void SummarizeMinimum(const RunRecord& record, const char* series, const char* key,
                      nlohmann::json& row) {
  const auto found = record.frames.find(series);
  if (found == record.frames.end()) return;
  const std::vector<double> values = PresentValues(found->second);
  if (!values.empty()) row[key] = *std::min_element(values.begin(), values.end());
}

void SummarizeMaximum(const RunRecord& record, const char* series, const char* key,
                      nlohmann::json& row) {
  const auto found = record.frames.find(series);
  if (found == record.frames.end()) return;
  const std::vector<double> values = PresentValues(found->second);
  if (!values.empty()) row[key] = Maximum(values);
}

// Sums of many terms differ by rounding, which is not a rise.
constexpr double kRiseAbove = 1e-9;

void SummarizeEnergies(const RunRecord& record, nlohmann::json& row) {
  double sum = 0.0;
  bool has_energies = false;
  for (const auto& [name, values] : record.frames) {
    if (FindMetric(name).family != kEnergyOfTerm) continue;
    has_energies = true;
    sum += Mean(PresentValues(values));
  }
  if (has_energies) row["energy_mean"] = sum;
  const auto rise = record.frames.find("energy_rise");
  if (rise == record.frames.end()) return;
  row["energy_rises"] = std::count_if(rise->second.begin(), rise->second.end(),
                                      [](double share) { return share > kRiseAbove; });
  SummarizeMaximum(record, "energy_rise", "energy_rise_max", row);
}

}  // namespace

void SummarizeHealth(const RunRecord& record, nlohmann::json& row) {
  SummarizeMaximum(record, "condition", "condition_max", row);
  SummarizeMaximum(record, "rotation_drift", "rotation_drift_max", row);
  SummarizeMaximum(record, "weak_directions", "weak_directions_max", row);
  SummarizeMinimum(record, "agreeing_digits", "agreeing_digits_min", row);
  row["non_finite"] = CountInfinite(record);
  SummarizeLosses(record, row);
  SummarizeEnergies(record, row);
}

}  // namespace vitruvia
