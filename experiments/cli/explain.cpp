#include "experiments/cli/explain.h"

#include "analysis/printed_metric.h"
#include "config/did_you_mean.h"
#include "core/error.h"
#include "experiments/cli/config_kinds.h"

namespace vitruvia {
namespace {

std::vector<FieldDescription> AllSettings() {
  std::vector<FieldDescription> all;
  for (const ConfigKind& kind : ConfigKinds()) {
    const std::vector<FieldDescription> more =
        DescribeSettings(kind.name, kind.visit, kind.file_kind);
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

std::vector<Metric> AllMetrics() {
  std::vector<Metric> all = MetricCatalogue();
  all.insert(all.end(), MetricFamilies().begin(), MetricFamilies().end());
  return all;
}

std::string WithUnit(const std::string& text, const std::string& unit) {
  return unit.empty() || text.empty() ? text : text + " " + unit;
}

std::string Line(const FieldDescription& field) {
  return fmt::format("{:<48} {}\n", field.key, WithUnit(field.default_value, field.unit));
}

std::string Paragraph(const FieldDescription& field) {
  std::string text = fmt::format("{}\n  {}\n  type:    {}\n", field.key, field.meaning, field.type);
  if (!field.range.empty())
    text += fmt::format("  range:   {}\n", WithUnit(field.range, field.unit));
  if (!field.default_value.empty()) {
    text += fmt::format("  default: {} ({}{}{})\n", WithUnit(field.default_value, field.unit),
                        field.origin, field.source.empty() ? "" : "; ", field.source);
  }
  return text;
}

bool Matches(const std::string& key, const std::string& wanted) {
  return ("." + key + ".").find("." + wanted + ".") != std::string::npos || key.starts_with(wanted);
}

}  // namespace

std::string Explain(const std::string& key) {
  std::string text;
  std::vector<std::string> names;
  for (const FieldDescription& field : AllSettings()) {
    if (key.empty()) {
      text += Line(field);
    } else if (Matches(field.key, key)) {
      text += Paragraph(field);
    }
    names.push_back(field.key);
    names.push_back(field.key.substr(field.key.rfind('.') + 1));
  }
  for (const Metric& metric : AllMetrics()) {
    if (key.empty()) text += fmt::format("{:<48} metric: {}\n", metric.key, Titled(metric));
    names.push_back(metric.key);
  }
  if (!key.empty() && UnknownMetricProblem(key).empty()) text += Explanation(FindMetric(key));
  if (text.empty()) {
    throw ConfigError(
        fmt::format("explain: no setting or metric \"{}\"{}", key, DidYouMean(key, names)));
  }
  return text;
}

}  // namespace vitruvia
