// Comparisons of variants in words, as JSON and as CSV.
#include <cmath>

#include <fmt/format.h>

#include "analysis/variant_comparison.h"

namespace vitruvia {
namespace {

// JSON has no infinities either: an unknown end of an interval is null.
nlohmann::json NumberOrNull(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

nlohmann::json SpreadToJson(const SampleSpread& spread) {
  return {{"mean", NumberOrNull(spread.mean)}, {"deviation", NumberOrNull(spread.deviation)}};
}

}  // namespace

std::string VerdictText(const VariantComparison& row) {
  const Difference verdict = row.comparison.verdict;
  if (verdict == Difference::kTooFewPairs || verdict == Difference::kNone) return Name(verdict);
  if (row.metric.better == Better::kNeither) return Name(verdict);
  const bool better = (verdict == Difference::kHigher) == (row.metric.better == Better::kHigher);
  return fmt::format("{} ({})", Name(verdict), better ? "better" : "worse");
}

std::string RelativeText(const VariantComparison& row) {
  const double share = row.comparison.difference.mean / row.reference_spread.mean;
  if (!std::isfinite(share)) return kNoNumber;
  return SignedNumber(1e2 * share, 1) + " %";
}

nlohmann::json ToJson(const std::vector<VariantComparison>& rows) {
  nlohmann::json list = nlohmann::json::array();
  for (const VariantComparison& row : rows) {
    list.push_back(
        {{"metric", row.metric.key},
         {"reference", row.reference},
         {"other", row.other},
         {"pairs", row.comparison.difference.count},
         {"unpaired_runs", row.unpaired},
         {"reference_value", SpreadToJson(row.reference_spread)},
         {"other_value", SpreadToJson(row.other_spread)},
         {"difference", SpreadToJson(row.comparison.difference)},
         {"interval",
          {NumberOrNull(row.comparison.interval.low), NumberOrNull(row.comparison.interval.high)}},
         {"verdict", VerdictText(row)}});
  }
  return {{"confidence", BootstrapSettings{}.confidence}, {"rows", list}};
}

nlohmann::json ToJson(const VariantTable& table) {
  nlohmann::json rows = nlohmann::json::array();
  for (const VariantSummary& row : table.rows) {
    nlohmann::json metrics = nlohmann::json::object();
    for (std::size_t m = 0; m < table.metrics.size(); ++m) {
      const VariantSummary::Cell& cell = row.cells[m];
      if (cell.spread.count == 0) continue;
      nlohmann::json& metric = metrics[table.metrics[m].key];
      metric = SpreadToJson(cell.spread);
      if (!cell.difference) continue;
      const PairedComparison& c = cell.difference->comparison;
      metric["difference"] = {
          {"mean", NumberOrNull(c.difference.mean)},
          {"interval", {NumberOrNull(c.interval.low), NumberOrNull(c.interval.high)}},
          {"pairs", c.difference.count},
          {"verdict", VerdictText(*cell.difference)}};
    }
    rows.push_back({{"variant", row.name}, {"runs", row.runs}, {"metrics", metrics}});
  }
  return {{"confidence", BootstrapSettings{}.confidence},
          {"reference", table.rows.empty() ? "" : table.rows.front().name},
          {"rows", rows}};
}

std::string ToCsv(const std::vector<VariantComparison>& rows) {
  std::string csv =
      "metric,reference,other,pairs,unpaired_runs,reference_mean,reference_deviation,other_mean,"
      "other_deviation,difference,difference_deviation,interval_low,interval_high,verdict\r\n";
  const auto number = [](double value) {
    return std::isfinite(value) ? nlohmann::json(value).dump() : std::string();
  };
  for (const VariantComparison& row : rows) {
    const PairedComparison& c = row.comparison;
    csv += fmt::format("{},\"{}\",\"{}\",{},{},{},{},{},{},{},{},{},{},{}\r\n", row.metric.key,
                       row.reference, row.other, c.difference.count, row.unpaired,
                       number(row.reference_spread.mean), number(row.reference_spread.deviation),
                       number(row.other_spread.mean), number(row.other_spread.deviation),
                       number(c.difference.mean), number(c.difference.deviation),
                       number(c.interval.low), number(c.interval.high), VerdictText(row));
  }
  return csv;
}

}  // namespace vitruvia
