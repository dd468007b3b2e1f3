#include "analysis/metric_names.h"

#include <array>

#include <fmt/format.h>

#include "records/metric_value.h"

namespace vitruvia {
namespace {

constexpr const char* kNoNumber = "–";
constexpr const char* kMinus = "−";

const std::array kKnown = {
    MetricName{"variant", "variant", "", 1.0, 0},
    MetricName{"scene", "scene", "", 1.0, 0},
    MetricName{"method", "method", "", 1.0, 0},
    MetricName{"seed", "seed", "", 1.0, 0},
    MetricName{"run_id", "run", "", 1.0, 0},
    MetricName{"frames", "frames", "", 1.0, 0},
    MetricName{"frames_failed", "failed frames", "", 1.0, 0},
    MetricName{"frames_lost", "lost frames", "", 1.0, 1},
    MetricName{"l2_mean_m", "mean L2 error", "mm", 1e3, 2},
    MetricName{"l2_max_m", "maximum L2 error", "mm", 1e3, 1},
    MetricName{"l2_mean_of_diagonal", "mean L2 error / diagonal", "", 1.0, 5},
    MetricName{"l2_max_of_diagonal", "maximum L2 error / diagonal", "", 1.0, 5},
    MetricName{"joint_error_mean_m", "mean joint error", "mm", 1e3, 2},
    MetricName{"joints_within_10cm", "joints within 10 cm", "%", 1e2, 2},
    MetricName{"frame_ms_median", "time per frame, median", "ms", 1.0, 1},
    MetricName{"frame_ms_p95", "time per frame, 95th percentile", "ms", 1.0, 1},
    MetricName{"frame_ms_max", "time per frame, maximum", "ms", 1.0, 1},
    MetricName{"tracker_memory_mb", "the tracker's memory, at most", "MB", 1.0, 0},
    MetricName{"iterations_mean", "iterations per frame, mean", "", 1.0, 2},
    MetricName{kCalibratedTime, "time per frame, median / calibration kernel", "", 1.0, 3},
};

// "l2_mean_visible_m" reads "l2 mean visible".
std::string Spaced(std::string key) {
  for (char& c : key) {
    if (c == '_') c = ' ';
  }
  return key;
}

std::string WithMinus(std::string number) {
  if (!number.empty() && number[0] == '-') number.replace(0, 1, kMinus);
  return number;
}

}  // namespace

MetricName NameOfMetric(const std::string& key) {
  for (const MetricName& known : kKnown) {
    if (known.key == key) return known;
  }
  const auto without = [&](std::size_t letters) {
    return Spaced(key.substr(0, key.size() - letters));
  };
  if (key.find("within") != std::string::npos) return {key, Spaced(key), "%", 1e2, 2};
  if (key.ends_with("_of_diagonal")) return {key, without(12) + " / diagonal", "", 1.0, 5};
  if (key.ends_with("_m")) return {key, without(2), "mm", 1e3, 2};
  if (key.ends_with("_ms")) return {key, without(3), "ms", 1.0, 2};
  if (key.find("_ms_") != std::string::npos) return {key, Spaced(key), "ms", 1.0, 2};
  if (key.ends_with("_deg")) return {key, without(4), "°", 1.0, 2};
  if (key.ends_with("_s")) return {key, without(2), "s", 1.0, 2};
  return {key, Spaced(key), "", 1.0, 4};
}

std::string Printed(double value, const MetricName& metric) {
  return WithMinus(fmt::format("{:.{}f}", value * metric.scale, metric.decimals));
}

std::string PrintedSigned(double difference, const MetricName& metric) {
  return WithMinus(fmt::format("{:+.{}f}", difference * metric.scale, metric.decimals));
}

std::string PrintedCell(const nlohmann::json& cell, const MetricName& metric) {
  if (cell.is_null()) return kNoNumber;
  if (cell.is_string()) return cell.get<std::string>();
  if (cell.is_boolean()) return cell.get<bool>() ? "yes" : "no";
  if (cell.is_number_integer()) return WithMinus(cell.dump());
  if (cell.is_number()) return Printed(cell.get<double>(), metric);
  return cell.dump();
}

std::string Titled(const MetricName& metric) {
  return metric.unit.empty() ? metric.label : fmt::format("{} ({})", metric.label, metric.unit);
}

}  // namespace vitruvia
