// Comparisons of variants in words, as JSON and as CSV.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "analysis/variant_comparison.h"
#include "core/message.h"

namespace vitruvia {
namespace {

// JSON has no infinities either: an unknown end of an interval is null.
nlohmann::json NumberOrNull(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

nlohmann::json SpreadToJson(const SampleSpread& spread) {
  return {{"mean", NumberOrNull(spread.mean)}, {"deviation", NumberOrNull(spread.deviation)}};
}

// "setting=" where all first cells are values of one setting; else "".
std::string CommonSetting(const TextTable& table) {
  std::string common;
  for (const auto& row : table.rows) {
    if (row.size() < 2) continue;
    const std::string& name = row[0].text;
    const std::string setting = name.substr(0, name.find('=') + 1);
    if (setting.empty() || name.find(',') != std::string::npos) return "";
    if (!common.empty() && setting != common) return "";
    common = setting;
  }
  return common;
}

// Where the first column has values of one setting, its name goes into the head.
void NameSettingOnce(TextTable& table) {
  const std::string setting = CommonSetting(table);
  if (setting.empty()) return;
  table.head[0] = setting.substr(0, setting.size() - 1);
  for (auto& row : table.rows) {
    if (row.size() > 1) row[0].text.erase(0, setting.size());
  }
}

bool IsShown(const VariantComparison& row) {
  const Difference verdict = row.comparison.verdict;
  return verdict == Difference::kLower || verdict == Difference::kHigher;
}

}  // namespace

std::string VerdictText(const VariantComparison& row) {
  const Difference verdict = row.comparison.verdict;
  if (verdict == Difference::kTooFewPairs || verdict == Difference::kNotShown) return Name(verdict);
  if (row.metric.better == Better::kNeither) return Name(verdict);
  const bool better = (verdict == Difference::kHigher) == (row.metric.better == Better::kHigher);
  return fmt::format("{} ({})", Name(verdict), better ? "better" : "worse");
}

std::string SpreadText(const SampleSpread& spread, const Metric& metric) {
  if (spread.count == 0) return kNoNumber;
  std::string text = Printed(spread.mean, metric);
  if (!std::isnan(spread.deviation)) text += " ± " + Printed(spread.deviation, metric);
  return text;
}

std::string IntervalText(const VariantComparison& row) {
  const Interval& interval = row.comparison.interval;
  if (std::isinf(interval.low)) return kNoNumber;
  return fmt::format("{} … {}", PrintedSigned(interval.low, row.metric),
                     PrintedSigned(interval.high, row.metric));
}

std::string UnitsText(const PairedComparison& comparison) {
  return comparison.scenes > 1 ? Counted(comparison.scenes, "scene")
                               : Counted(comparison.unit_difference.count, "pair");
}

std::string MethodText(std::size_t count) {
  const double confidence = BootstrapSettings{}.confidence;
  return fmt::format(
      "Differences are of pairs of the same scene and seed; intervals are {:.0f} % bootstrap "
      "intervals that draw scenes, then seeds. A difference is called one only if its interval "
      "excludes zero, Student's test over the scenes (of a single scene: over its pairs) does with "
      "Holm's correction for {}, and there are at least {} pairs.",
      1e2 * confidence, Counted(count, "comparison"), FewestPairs(confidence));
}

TextTable ToText(const std::vector<VariantComparison>& rows) {
  TextTable table{{"variant", "mean ± sd", "difference", "95 % interval", "n"}, {}, {}};
  std::string metric;
  int scenes = 0;
  for (const VariantComparison& row : rows) {
    if (row.metric.key != metric) {
      table.rows.push_back({{Titled(row.metric)}});
      table.rows.push_back({{row.reference},
                            {SpreadText(row.reference_spread, row.metric)},
                            {"reference"},
                            {""},
                            {fmt::format("{}", row.reference_spread.count)}});
    }
    metric = row.metric.key;
    table.rows.push_back({{row.other},
                          {SpreadText(row.other_spread, row.metric)},
                          {PrintedSigned(row.comparison.difference.mean, row.metric), IsShown(row)},
                          {IntervalText(row)},
                          {fmt::format("{}", row.comparison.difference.count)}});
    scenes = std::max(scenes, row.comparison.scenes);
  }
  NameSettingOnce(table);
  table.notes = {fmt::format("n: pairs, of {}. Bold: differences that are shown; no other one is.",
                             Counted(scenes, "scene")),
                 MethodText(rows.size())};
  return table;
}

TextTable ToText(const VariantTable& table, const std::string& first_column) {
  TextTable text{{first_column, "n"}, {}, {}};
  bool has_best = false;
  for (const Metric& metric : table.metrics) text.head.push_back(Titled(metric));
  for (const VariantSummary& row : table.rows) {
    std::vector<TextCell>& cells = text.rows.emplace_back();
    cells = {{row.name}, {fmt::format("{}", row.runs)}};
    for (std::size_t m = 0; m < table.metrics.size(); ++m) {
      cells.push_back({SpreadText(row.cells[m].spread, table.metrics[m]), row.cells[m].is_best});
      has_best = has_best || row.cells[m].is_best;
    }
  }
  text.notes = {"Mean ± standard deviation over n runs."};
  if (has_best)
    text.notes.emplace_back(
        "Bold: the best of a column whose difference from the second best is shown.");
  if (table.rows.size() > 1 && !table.reference.empty())
    text.notes.push_back(MethodText(table.metrics.size()));
  NameSettingOnce(text);
  return text;
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
         {"independent", row.comparison.unit_difference.count},
         {"scenes", row.comparison.scenes},
         {"p", row.comparison.p},
         {"adjusted_p", row.comparison.adjusted_p},
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
          {"adjusted_p", c.adjusted_p},
          {"verdict", VerdictText(*cell.difference)}};
    }
    rows.push_back({{"variant", row.name}, {"runs", row.runs}, {"metrics", metrics}});
  }
  return {{"confidence", BootstrapSettings{}.confidence},
          {"reference", table.reference},
          {"rows", rows}};
}

std::string ToCsv(const std::vector<VariantComparison>& rows) {
  std::string csv =
      "metric,reference,other,pairs,unpaired_runs,reference_mean,reference_deviation,other_mean,"
      "other_deviation,difference,difference_deviation,interval_low,interval_high,scenes,p,"
      "adjusted_p,"
      "verdict\r\n";
  const auto number = [](double value) {
    return std::isfinite(value) ? nlohmann::json(value).dump() : std::string();
  };
  for (const VariantComparison& row : rows) {
    const PairedComparison& c = row.comparison;
    csv += fmt::format("{},\"{}\",\"{}\",{},{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n",
                       row.metric.key, row.reference, row.other, c.difference.count, row.unpaired,
                       number(row.reference_spread.mean), number(row.reference_spread.deviation),
                       number(row.other_spread.mean), number(row.other_spread.deviation),
                       number(c.difference.mean), number(c.difference.deviation),
                       number(c.interval.low), number(c.interval.high), c.scenes, number(c.p),
                       number(c.adjusted_p), VerdictText(row));
  }
  return csv;
}

}  // namespace vitruvia
