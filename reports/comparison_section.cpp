#include "reports/comparison_section.h"

#include <cmath>

#include <fmt/format.h>

#include "reports/html_text.h"
#include "reports/variant_comparison.h"

namespace vitruvia {
namespace {

std::string SpreadText(const SampleSpread& spread, const MetricName& metric) {
  std::string text = Printed(spread.mean, metric);
  if (!std::isnan(spread.deviation)) text += " ± " + Printed(spread.deviation, metric);
  return text;
}

std::string IntervalText(const VariantComparison& row) {
  const Interval& interval = row.comparison.interval;
  if (std::isinf(interval.low)) return "–";
  return fmt::format("{} … {}", PrintedSigned(interval.low, row.metric),
                     PrintedSigned(interval.high, row.metric));
}

const char* VerdictClass(const std::string& verdict) {
  if (verdict.ends_with("(better)")) return "verdict met";
  return verdict.ends_with("(worse)") ? "verdict missed" : "soft";
}

std::string GroupRow(const VariantComparison& row) {
  return fmt::format(
      "<tr class=\"group\"><th colspan=\"6\" scope=\"rowgroup\">{} <span class=\"soft\">· {}: "
      "{}</span></th></tr>\n",
      Escaped(Titled(row.metric)), Escaped(row.reference),
      SpreadText(row.reference_spread, row.metric));
}

std::string VariantRow(const VariantComparison& row) {
  const std::string verdict = VerdictText(row);
  const int pairs = row.comparison.difference.count;
  return fmt::format(
      "<tr><td class=\"run\">{}</td><td class=\"n\" data-label=\"mean ± spread\">{}</td>"
      "<td class=\"n\" data-label=\"difference\">{} <span class=\"soft\">({})</span></td>"
      "<td class=\"n\" data-label=\"95 % interval\">{}</td>"
      "<td class=\"n\" data-label=\"pairs\">{}{}</td><td class=\"{}\">{}</td></tr>\n",
      Escaped(row.other), SpreadText(row.other_spread, row.metric),
      PrintedSigned(row.comparison.difference.mean, row.metric), RelativeText(row),
      IntervalText(row), pairs,
      row.unpaired == 0 ? "" : fmt::format(" <span class=\"soft\">+ {} alone</span>", row.unpaired),
      VerdictClass(verdict), verdict);
}

}  // namespace

std::string ComparisonSection(const ReportedExperiment& experiment) {
  if (ContendersOf(experiment).size() < 2) return "";
  const std::vector<VariantComparison> rows = CompareVariants(experiment, "", {});
  if (rows.empty()) return "";
  std::string html = fmt::format(
      "<section id=\"variants\"><h2>Variants against {}</h2>\n<p>Paired by scene and seed: mean ± "
      "standard deviation over the pairs, the mean difference and its {:.0f} % bootstrap interval. "
      "A difference is called one only if the interval excludes zero and there are at least {} "
      "pairs.</p><div class=\"scroll\"><table class=\"compare\"><thead><tr><th>variant</th>"
      "<th class=\"n\">mean ± spread</th><th class=\"n\">difference</th><th class=\"n\">interval"
      "</th><th class=\"n\">pairs</th><th></th></tr></thead><tbody>\n",
      Escaped(rows.front().reference), 1e2 * BootstrapSettings{}.confidence,
      FewestPairs(BootstrapSettings{}.confidence));
  std::string metric;
  for (const VariantComparison& row : rows) {
    if (row.metric.key != metric) html += GroupRow(row);
    metric = row.metric.key;
    html += VariantRow(row);
  }
  return html + "</tbody></table></div></section>\n";
}

}  // namespace vitruvia
