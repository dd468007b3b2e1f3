#include "analysis/printed_metric.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vitruvia {
namespace {

std::string WithMinusSign(std::string number) {
  constexpr const char* kMinus = "−";
  if (!number.empty() && number[0] == '-') number.replace(0, 1, kMinus);
  return number;
}

}  // namespace

std::string Printed(double value, const Metric& metric) {
  return WithMinusSign(fmt::format("{:.{}f}", value * metric.scale, metric.decimals));
}

std::string PrintedSigned(double difference, const Metric& metric) {
  return SignedNumber(difference * metric.scale, metric.decimals);
}

std::string SignedNumber(double number, int decimals) {
  return WithMinusSign(fmt::format("{:+.{}f}", number, decimals));
}

std::string PrintedCell(const nlohmann::json& cell, const Metric& metric) {
  if (cell.is_null()) return kNoNumber;
  if (cell.is_string()) return cell.get<std::string>();
  if (cell.is_boolean()) return cell.get<bool>() ? "yes" : "no";
  if (cell.is_number_integer()) return WithMinusSign(cell.dump());
  if (cell.is_number()) return Printed(cell.get<double>(), metric);
  return cell.dump();
}

std::string Titled(const Metric& metric) {
  return metric.unit.empty() ? metric.label : fmt::format("{} ({})", metric.label, metric.unit);
}

std::string UnitText(const Metric& metric) {
  if (metric.unit.empty() || metric.scale == 1.0) return metric.unit;
  return fmt::format("{} in tables; stored value × {:g}", metric.unit, metric.scale);
}

std::string Explanation(const Metric& metric) {
  std::string text = fmt::format("{}\n  {}\n  {}\n", metric.key, metric.label, metric.definition);
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) text += fmt::format("  {:<9}{}\n", fmt::format("{}:", name), value);
  };
  add("formula", metric.formula);
  add("over", metric.averaged_over);
  add("counts", metric.hidden_and_lost);
  add("unit", UnitText(metric));
  add("better", Name(metric.better));
  return text;
}

}  // namespace vitruvia
