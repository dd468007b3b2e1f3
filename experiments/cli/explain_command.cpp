#include "experiments/cli/explain_command.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <memory>

#include <CLI/CLI.hpp>

#include "analysis/metrics_page.h"
#include "analysis/printed_metric.h"
#include "config/did_you_mean.h"
#include "core/error.h"
#include "experiments/cli/config_kinds.h"

namespace vitruvia {
namespace {

constexpr const char* kExplainFooter =
    "Of settings that a sweep can vary the path to paste into \"setting\" is printed.";

struct ExplainedSetting {
  FieldDescription field;
  std::string sweep_path;  // "" where a sweep cannot vary it
};

// A sweep varies single values; seeds have a list of their own.
std::string SweepPath(const ConfigKind& kind, const FieldDescription& field) {
  constexpr std::array kSingleValues = {"number", "whole number", "true or false", "text"};
  const bool is_single =
      std::find(kSingleValues.begin(), kSingleValues.end(), field.type) != kSingleValues.end() ||
      field.type.starts_with("one of ");
  const bool in_list = field.key.find("[]") != std::string::npos;
  if (kind.sweep_prefix.empty() || !is_single || in_list || field.key == "scene.seed") return "";
  return kind.sweep_prefix + field.key.substr(kind.name.size());
}

std::vector<ExplainedSetting> AllSettings() {
  std::vector<ExplainedSetting> all;
  for (const ConfigKind& kind : ConfigKinds()) {
    for (FieldDescription& field : DescribeSettings(kind.name, kind.visit, kind.file_kind)) {
      std::string path = SweepPath(kind, field);
      all.push_back({std::move(field), std::move(path)});
    }
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

std::string Paragraph(const ExplainedSetting& setting) {
  const FieldDescription& field = setting.field;
  std::string text = fmt::format("{}\n  {}\n  type:    {}\n", field.key, field.meaning, field.type);
  if (!field.range.empty())
    text += fmt::format("  range:   {}\n", WithUnit(field.range, field.unit));
  if (!field.default_value.empty()) {
    text += fmt::format("  default: {} ({}{}{})\n", WithUnit(field.default_value, field.unit),
                        field.origin, field.source.empty() ? "" : "; ", field.source);
  }
  if (!setting.sweep_path.empty()) text += fmt::format("  sweep:   {}\n", setting.sweep_path);
  return text;
}

bool Matches(const std::string& key, const std::string& wanted) {
  return ("." + key + ".").find("." + wanted + ".") != std::string::npos || key.starts_with(wanted);
}

std::string ListOfAll() {
  std::string text;
  for (const ExplainedSetting& setting : AllSettings()) text += Line(setting.field);
  for (const Metric& metric : AllMetrics())
    text += fmt::format("{:<48} metric: {}\n", metric.key, Titled(metric));
  return text;
}

std::string Explain(const std::string& key) {
  std::string text;
  std::vector<std::string> names;
  for (const ExplainedSetting& setting : AllSettings()) {
    const std::string& name = setting.field.key;
    if (Matches(name, key) || setting.sweep_path == key) text += Paragraph(setting);
    names.push_back(name);
    names.push_back(setting.sweep_path);
    names.push_back(name.substr(name.rfind('.') + 1));
  }
  for (const Metric& metric : AllMetrics()) names.push_back(metric.key);
  if (UnknownMetricProblem(key).empty()) text += Explanation(FindMetric(key));
  if (text.empty()) {
    throw ConfigError(
        fmt::format("explain: no setting or metric \"{}\"{}; --search looks for words", key,
                    DidYouMean(key, names)));
  }
  return text;
}

std::string Lowered(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// Whether the text has all of the words, in lower case, in any order.
bool HasAll(const std::string& text, const std::vector<std::string>& words) {
  const std::string lowered = Lowered(text);
  return std::all_of(words.begin(), words.end(), [&](const std::string& word) {
    return lowered.find(word) != std::string::npos;
  });
}

std::string TextOf(const FieldDescription& field) {
  return fmt::format("{} {} {} {}", field.key, field.meaning, field.type, field.source);
}

std::string TextOf(const Metric& metric) {
  return fmt::format("{} {} {}", metric.key, metric.label, metric.definition);
}

std::string Search(std::vector<std::string> words) {
  for (std::string& word : words) word = Lowered(std::move(word));
  std::string text;
  for (const ExplainedSetting& setting : AllSettings()) {
    if (HasAll(TextOf(setting.field), words)) text += Paragraph(setting);
  }
  for (const Metric& metric : AllMetrics()) {
    if (HasAll(TextOf(metric), words)) text += Explanation(metric);
  }
  if (text.empty()) {
    throw ConfigError(fmt::format("explain: no setting or metric has all of the words {}",
                                  fmt::join(words, ", ")));
  }
  return text;
}

struct ExplainArguments {
  std::string key;
  std::vector<std::string> words;
  bool metrics = false;
};

std::string TextFor(const ExplainArguments& a) {
  if (a.metrics) return MetricsPage();
  if (!a.words.empty()) return Search(a.words);
  return a.key.empty() ? ListOfAll() : Explain(a.key);
}

}  // namespace

void AddExplainCommand(CLI::App& app) {
  const auto a = std::make_shared<ExplainArguments>();
  CLI::App* explain =
      app.add_subcommand("explain", "Explain a setting or a metric; without KEY list all");
  CLI::Option* key = explain->add_option(
      "KEY", a->key,
      "a setting's key or the beginning of one, a path that a sweep varies, or a metric's key");
  CLI::Option* search =
      explain->add_option("--search", a->words, "settings and metrics whose text has all WORDS")
          ->type_name("WORDS")
          ->excludes(key);
  explain->add_flag("--metrics", a->metrics, "all metrics as a page of Markdown: docs/metrics.md")
      ->excludes(key)
      ->excludes(search);
  explain->footer(kExplainFooter);
  explain->callback([a] { fmt::print("{}", TextFor(*a)); });
}

}  // namespace vitruvia
