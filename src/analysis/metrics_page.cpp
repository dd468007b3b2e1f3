#include "analysis/metrics_page.h"

#include <fmt/format.h>

#include "analysis/printed_metric.h"

namespace vitruvia {
namespace {

constexpr const char* kHead =
    "# Metrics\n"
    "\n"
    "All metrics of run records, as `vitruvia explain --metrics` prints them; `vitruvia explain "
    "KEY` explains one, `vitruvia explain --search WORDS` finds some.\n";

std::string Item(const char* name, const std::string& value, const char* quote = "") {
  return value.empty() ? "" : fmt::format("- {}: {}{}{}\n", name, quote, value, quote);
}

std::string Paragraph(const Metric& metric) {
  std::string text =
      fmt::format("\n### `{}`\n\n{}. {}\n", metric.key, Titled(metric), metric.definition);
  const std::string items =
      Item("formula", metric.formula, "`") + Item("averaged over", metric.averaged_over) +
      Item("hidden and lost", metric.hidden_and_lost) + Item("unit", UnitText(metric));
  if (items.empty() && metric.better == Better::kNeither) return text;
  return text + "\n" + items + Item("direction", Name(metric.better));
}

std::string Section(const std::string& title, const std::vector<Metric>& metrics) {
  std::string text = fmt::format("\n## {}\n", title);
  for (const Metric& metric : metrics) text += Paragraph(metric);
  return text;
}

}  // namespace

std::string MetricsPage() {
  std::string page = kHead;
  page += "\n## Symbols\n\n";
  for (const std::string& symbol : FormulaSymbols()) page += fmt::format("- {}\n", symbol);
  for (const MetricGroup& group : MetricGroups()) page += Section(group.title, group.metrics);
  return page + Section("One for each joint, step, term or summary", MetricFamilies());
}

}  // namespace vitruvia
