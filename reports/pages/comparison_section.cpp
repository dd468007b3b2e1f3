#include "reports/pages/comparison_section.h"

#include <cmath>

#include <fmt/format.h>

#include "analysis/variant_comparison.h"
#include "reports/drawing/html_text.h"

namespace vitruvia {
namespace {

bool HasInterval(const VariantComparison& row) {  // a single pair has none
  return !std::isinf(row.comparison.interval.low);
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
      "<td class=\"n\" data-label=\"pairs\">{} <span class=\"soft\">({})</span>{}</td>"
      "<td class=\"{}\">{}</td></tr>\n",
      Escaped(row.other), SpreadText(row.other_spread, row.metric),
      PrintedSigned(row.comparison.difference.mean, row.metric), RelativeText(row),
      IntervalText(row), pairs, UnitsText(row.comparison),
      row.unpaired == 0 ? "" : fmt::format(" <span class=\"soft\">+ {} alone</span>", row.unpaired),
      VerdictClass(verdict), verdict);
}

std::string SummaryOf(const VariantSummary::Cell& cell, const Metric& metric) {
  if (cell.spread.count == 0) return "<td class=\"n\">–</td>";
  std::string text = SpreadText(cell.spread, metric);
  if (cell.difference) {
    const std::string verdict = VerdictText(*cell.difference);
    text += fmt::format(
        "<small class=\"{}\" title=\"{}\">{}{}</small>", VerdictClass(verdict), verdict,
        PrintedSigned(cell.difference->comparison.difference.mean, metric),
        HasInterval(*cell.difference) ? "<br>[" + IntervalText(*cell.difference) + "]" : "");
  }
  return fmt::format("<td class=\"n\" data-label=\"{}\" data-value=\"{}\">{}</td>",
                     Escaped(Titled(metric)), cell.spread.mean, text);
}

std::size_t ComparisonsIn(const VariantTable& table) {
  std::size_t count = 0;
  for (const VariantSummary& row : table.rows) {
    for (const VariantSummary::Cell& cell : row.cells) count += cell.difference ? 1 : 0;
  }
  return count;
}

}  // namespace

std::string VariantSection(const ReportedExperiment& experiment) {
  const VariantTable table = TabulateVariants(experiment);
  if (table.rows.size() < 2) return "";
  std::string html = fmt::format(
      "<section id=\"summary\"><h2>{} variants, {} runs</h2>\n<p>Mean over all scenes, seeds and "
      "repeats ± standard deviation over the runs; below it the mean difference to <b>{}</b> with "
      "its interval. {} Green is better, red worse; neither where no difference is shown.</p><div "
      "class=\"scroll\">"
      "<table class=\"sortable variants\"><thead><tr><th><button type=\"button\">variant</button>"
      "</th><th><button type=\"button\">runs</button></th>",
      table.rows.size(), experiment.finished().size(), Escaped(table.reference),
      MethodText(ComparisonsIn(table)));
  for (const Metric& metric : table.metrics)
    html += fmt::format("<th class=\"n\"><button type=\"button\">{}</button></th>",
                        Escaped(Titled(metric)));
  html += "</tr></thead><tbody>\n";
  for (const VariantSummary& row : table.rows) {
    html += fmt::format(
        "<tr><td class=\"run\" data-value=\"{0}\">{0}</td><td class=\"n\" data-label=\"runs\" "
        "data-value=\"{1}\">{1}</td>",
        Escaped(row.name), row.runs);
    for (std::size_t m = 0; m < table.metrics.size(); ++m)
      html += SummaryOf(row.cells[m], table.metrics[m]);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div></section>\n";
}

std::string ComparisonSection(const ReportedExperiment& experiment) {
  if (ContendersOf(experiment).size() < 2) return "";
  const std::vector<VariantComparison> rows = CompareVariants(experiment, "", {});
  if (rows.empty()) return "";
  std::string html = fmt::format(
      "<section id=\"variants\"><h2>Variants against {}</h2>\n<p>Mean ± standard deviation over "
      "the pairs, the mean difference and its interval. {}</p><div class=\"scroll\"><table "
      "class=\"compare\"><thead><tr><th>variant</th>"
      "<th class=\"n\">mean ± spread</th><th class=\"n\">difference</th><th class=\"n\">interval"
      "</th><th class=\"n\">pairs</th><th></th></tr></thead><tbody>\n",
      Escaped(rows.front().reference), MethodText(rows.size()));
  std::string metric;
  for (const VariantComparison& row : rows) {
    if (row.metric.key != metric) html += GroupRow(row);
    metric = row.metric.key;
    html += VariantRow(row);
  }
  return html + "</tbody></table></div></section>\n";
}

}  // namespace vitruvia
