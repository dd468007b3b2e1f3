#include "metrics/catalogue.h"

#include <algorithm>
#include <optional>

#include "config/did_you_mean.h"
#include "core/error.h"

namespace vitruvia {
namespace {

// A family's key or label, cut at its parameter in braces.
struct Pattern {
  explicit Pattern(const std::string& text) {
    const std::size_t open = text.find('{'), close = text.find('}');
    Require(open < close && close != std::string::npos, "\"{}\" has no parameter in braces", text);
    before = text.substr(0, open);
    after = text.substr(close + 1);
  }

  std::string With(const std::string& member) const { return before + member + after; }

  // What stands for the parameter in `text`; nothing if the text does not match.
  std::optional<std::string> MemberIn(const std::string& text) const {
    const bool matches = text.size() > before.size() + after.size() && text.starts_with(before) &&
                         text.ends_with(after);
    if (!matches) return std::nullopt;
    return text.substr(before.size(), text.size() - before.size() - after.size());
  }

  std::string before, after;
};

std::optional<Metric> MemberOfFamily(const Metric& family, const std::string& key) {
  const std::optional<std::string> member = Pattern(family.key).MemberIn(key);
  if (!member) return std::nullopt;
  Metric metric = family;
  metric.key = key;
  metric.label = Pattern(family.label).With(*member);
  metric.family = family.key;
  metric.member = *member;
  return metric;
}

// Metrics of their own come before members of families.
std::optional<Metric> Lookup(const std::string& key) {
  for (const Metric& metric : MetricCatalogue()) {
    if (metric.key == key) return metric;
  }
  for (const Metric& family : MetricFamilies()) {
    if (std::optional<Metric> member = MemberOfFamily(family, key)) return member;
  }
  return std::nullopt;
}

// All keys that could have been meant, among them each family's for what the key has in brackets.
std::vector<std::string> KeysLike(const std::string& key) {
  std::vector<std::string> keys;
  for (const Metric& metric : MetricCatalogue()) keys.push_back(metric.key);
  const std::size_t open = key.find('['), close = key.rfind(']');
  if (open == std::string::npos || close == std::string::npos || close <= open) return keys;
  for (const Metric& family : MetricFamilies()) {
    keys.push_back(Pattern(family.key).With(key.substr(open + 1, close - open - 1)));
  }
  return keys;
}

}  // namespace

const char* Name(Better better) {
  switch (better) {
    case Better::kLower:
      return "lower is better";
    case Better::kHigher:
      return "higher is better";
    case Better::kNeither:
      return "neither is better";
  }
  return "";
}

bool Metric::IsShownIn(Place place) const {
  return std::find(shown_in.begin(), shown_in.end(), place) != shown_in.end();
}

std::string UnknownMetricProblem(const std::string& key) {
  if (Lookup(key)) return "";
  const std::string nearest = NearestWord(key, KeysLike(key));
  return fmt::format("unknown metric \"{}\"; {}", key,
                     nearest.empty() ? "vitruvia explain lists all metrics"
                                     : fmt::format("did you mean \"{}\"?", nearest));
}

Metric FindMetric(const std::string& key) {
  std::optional<Metric> metric = Lookup(key);
  if (!metric) throw ConfigError(UnknownMetricProblem(key));
  return *std::move(metric);
}

std::vector<Metric> MetricsShownIn(Place place) {
  std::vector<Metric> shown;
  for (const Metric& metric : MetricCatalogue()) {
    if (metric.IsShownIn(place)) shown.push_back(metric);
  }
  return shown;
}

}  // namespace vitruvia
