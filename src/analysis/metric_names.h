// How the metrics of a summary row are called and printed.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace vitruvia {

struct MetricName {
  std::string key;     // of the summary row
  std::string label;   // for people
  std::string unit;    // of the printed number; "" for shares and counts
  double scale = 1.0;  // printed = stored × scale
  int decimals = 3;
};

// A known metric, or one whose unit follows from the key's ending.
MetricName NameOfMetric(const std::string& key);

std::string Printed(double value, const MetricName& metric);  // without unit
std::string PrintedSigned(double difference, const MetricName& metric);
// A cell of a summary row: number, text or null.
std::string PrintedCell(const nlohmann::json& cell, const MetricName& metric);
// "label (unit)"
std::string Titled(const MetricName& metric);

}  // namespace vitruvia
