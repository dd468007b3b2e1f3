#include "scoring/run_health.h"

#include <algorithm>
#include <cmath>

#include "math/statistics.h"

namespace vitruvia {
namespace {

// A frame is lost when the tracker says so or when what the camera could see of the surface is this
// far off on average. Without a true surface nobody can say.
constexpr double kLostAbove_m = 0.05;

// How often the subject was lost, and how many frames it took at the longest to find it again; -1
// if it was not found again before the end.
void SummarizeLosses(const RunRecord& record, nlohmann::json& row) {
  if (!record.frames.contains("l2_mean_visible_m")) return;
  const auto& failed = record.frames.at("failed");
  const auto& error_m = record.frames.at("l2_mean_visible_m");
  int lost = 0, run = 0, longest = 0;
  for (std::size_t i = 0; i < failed.size(); ++i) {
    run = failed[i] > 0.0 || error_m[i] > kLostAbove_m ? run + 1 : 0;
    lost += run > 0 ? 1 : 0;
    longest = std::max(longest, run);
  }
  row["frames_lost"] = lost;
  row["frames_to_recover"] = run > 0 ? -1 : longest;
}

// Everything stored that is no number. Vertices and joints cannot be: neither writer nor reader of
// estimates lets them pass; so a joint error that is none only says that no true joint was known.
int NonFinite(const RunRecord& record) {
  int count = 0;
  for (const auto& [name, values] : record.frames) {
    if (name.starts_with("joint_error_")) continue;
    count += static_cast<int>(
        std::count_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); }));
  }
  return count;
}

// Sums of many terms differ by rounding; that is no rise.
constexpr double kRiseAbove = 1e-9;

void SummarizeEnergies(const RunRecord& record, nlohmann::json& row) {
  double sum = 0.0;
  bool has_energies = false;
  for (const auto& [name, values] : record.frames) {
    if (!name.starts_with("energy_") || name == "energy_rise") continue;
    has_energies = true;
    sum += Mean(values);
  }
  if (has_energies) row["energy_mean"] = sum;
  const std::vector<double>& rise = record.frames.at("energy_rise");
  if (Maximum(rise) < 0.0) return;  // nobody looked
  row["energy_rises"] =
      std::count_if(rise.begin(), rise.end(), [](double share) { return share > kRiseAbove; });
  row["energy_rise_max"] = Maximum(rise);
}

}  // namespace

void SummarizeHealth(const RunRecord& record, nlohmann::json& row) {
  row["condition_max"] = Maximum(record.frames.at("condition"));
  row["rotation_drift_max"] = Maximum(record.frames.at("rotation_drift"));
  row["non_finite"] = NonFinite(record);
  SummarizeLosses(record, row);
  SummarizeEnergies(record, row);
}

}  // namespace vitruvia
