#include "analysis/variant_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "config/did_you_mean.h"
#include "core/error.h"
#include "records/metric_value.h"

namespace vitruvia {
namespace {

constexpr std::array kComparedMetrics = {
    "frames_failed",      "frames_lost",        "l2_mean_of_diagonal", "l2_max_of_diagonal",
    "joint_error_mean_m", "joints_within_10cm", "twist_rms_deg",       "jitter_rms_rad_s2",
    "surface_mean_m",     "surface_max_m",      "height_error_m",      "weight_error_kg",
    "frame_ms_median",    "frame_ms_p95",       kCalibratedTime};

// What one looks at first.
constexpr std::array kTabulatedMetrics = {
    "frames_failed",      "l2_mean_of_diagonal", "l2_max_of_diagonal", "joint_error_mean_m",
    "joints_within_10cm", "surface_mean_m",      "surface_max_m",      "frame_ms_median"};

struct RunPair {
  const RunRecord* reference;
  const RunRecord* other;
};
struct PairedRuns {
  std::string reference, other;
  std::vector<RunPair> pairs;
  int unpaired = 0;
};

// What two runs must share to be a pair.
std::string PairKey(const RunRecord& run) {
  const double repeat = MetricValue(run, "repeat");
  return fmt::format("{}\n{}\n{}", run.scene, run.seed, std::isnan(repeat) ? 1.0 : repeat);
}

PairedRuns Paired(const Contender& reference, const Contender& other) {
  PairedRuns paired{reference.name, other.name, {}, 0};
  std::map<std::string, const RunRecord*> partners;
  for (const RunRecord* run : reference.runs) partners[PairKey(*run)] = run;
  for (const RunRecord* run : other.runs) {
    const auto partner = partners.find(PairKey(*run));
    if (partner == partners.end()) continue;
    paired.pairs.push_back({partner->second, run});
  }
  paired.unpaired =
      static_cast<int>(reference.runs.size() + other.runs.size() - 2 * paired.pairs.size());
  return paired;
}

// Those asked for, or the usual ones that some pair has; counts of failures only if there are any.
std::vector<std::string> MetricsToCompare(const std::vector<RunPair>& pairs,
                                          const std::vector<std::string>& asked) {
  const auto is_there = [&](const std::string& key) {
    return std::any_of(pairs.begin(), pairs.end(), [&](const RunPair& pair) {
      return !std::isnan(MetricValue(*pair.reference, key)) &&
             !std::isnan(MetricValue(*pair.other, key));
    });
  };
  const auto says_something = [&](const std::string& key) {  // not 0 in all runs
    return is_there(key) && std::any_of(pairs.begin(), pairs.end(), [&](const RunPair& pair) {
             return MetricValue(*pair.reference, key) != 0.0 ||
                    MetricValue(*pair.other, key) != 0.0;
           });
  };
  std::vector<std::string> metrics;
  if (asked.empty()) {
    std::copy_if(kComparedMetrics.begin(), kComparedMetrics.end(), std::back_inserter(metrics),
                 says_something);
    return metrics;
  }
  for (const std::string& key : asked) {
    if (is_there(key)) continue;
    std::vector<std::string> known;
    for (const RunPair& pair : pairs) {
      for (const auto& item : pair.other->summary.items()) known.push_back(item.key());
    }
    throw ConfigError(
        fmt::format("metric \"{}\": no pair of runs has it{}", key, DidYouMean(key, known)));
  }
  return asked;
}

VariantComparison Compared(const PairedRuns& paired, const std::string& metric) {
  VariantComparison row{
      NameOfMetric(metric), paired.reference, paired.other, paired.unpaired, {}, {}, {}};
  std::vector<double> reference, other;
  for (const RunPair& pair : paired.pairs) {
    const double a = MetricValue(*pair.reference, metric), b = MetricValue(*pair.other, metric);
    if (std::isnan(a) || std::isnan(b)) {
      row.unpaired += 2;
      continue;
    }
    reference.push_back(a);
    other.push_back(b);
  }
  if (other.empty()) return row;
  row.reference_spread = SpreadOf(reference);
  row.other_spread = SpreadOf(other);
  row.comparison = ComparePairs(reference, other);
  return row;
}

std::vector<VariantComparison> Table(const std::vector<PairedRuns>& all,
                                     const std::vector<std::string>& asked) {
  std::vector<RunPair> pairs;
  for (const PairedRuns& paired : all)
    pairs.insert(pairs.end(), paired.pairs.begin(), paired.pairs.end());
  std::vector<VariantComparison> rows;
  for (const std::string& metric : MetricsToCompare(pairs, asked)) {
    for (const PairedRuns& paired : all) {
      const VariantComparison row = Compared(paired, metric);
      if (row.other_spread.count > 0) rows.push_back(row);
    }
  }
  return rows;
}

std::vector<std::string> NamesOf(const std::vector<Contender>& contenders) {
  std::vector<std::string> names;
  for (const Contender& contender : contenders) names.push_back(contender.name);
  return names;
}

std::string FullName(const RunRecord& run) { return run.method + "/" + run.variant; }

// By full names, so that two folders agree on them.
std::vector<Contender> ContendersByFullName(const ReportedExperiment& experiment) {
  std::vector<Contender> contenders;
  for (const RunRecord* run : experiment.finished()) {
    const std::string name = FullName(*run);
    const auto found = std::find_if(contenders.begin(), contenders.end(),
                                    [&](const Contender& c) { return c.name == name; });
    if (found == contenders.end()) {
      contenders.push_back({name, {run}});
    } else {
      found->runs.push_back(run);
    }
  }
  return contenders;
}

std::vector<double> ValuesOf(const Contender& contender, const std::string& metric) {
  std::vector<double> values;
  for (const RunRecord* run : contender.runs) {
    const double value = MetricValue(*run, metric);
    if (!std::isnan(value)) values.push_back(value);
  }
  return values;
}

// Without those that are 0 in all runs; means of counts are no whole numbers.
std::vector<MetricName> TabulatedMetrics(const std::vector<Contender>& contenders) {
  std::vector<MetricName> metrics;
  for (const char* metric : kTabulatedMetrics) {
    const bool says_something =
        std::any_of(contenders.begin(), contenders.end(), [metric](const Contender& contender) {
          const std::vector<double> values = ValuesOf(contender, metric);
          return std::any_of(values.begin(), values.end(), [](double v) { return v != 0.0; });
        });
    if (!says_something) continue;
    metrics.push_back(NameOfMetric(metric));
    metrics.back().decimals = std::max(metrics.back().decimals, 1);
  }
  return metrics;
}

}  // namespace

std::vector<Contender> ContendersOf(const ReportedExperiment& experiment) {
  std::vector<Contender> contenders = ContendersByFullName(experiment);
  std::set<std::string> methods, variants;
  for (const Contender& contender : contenders) {
    methods.insert(contender.runs.front()->method);
    variants.insert(contender.runs.front()->variant);
  }
  for (Contender& contender : contenders) {
    const RunRecord& run = *contender.runs.front();
    if (methods.size() == 1) contender.name = run.variant;
    if (methods.size() > 1 && variants.size() == 1) contender.name = run.method;
  }
  return contenders;
}

std::vector<VariantComparison> CompareVariants(const ReportedExperiment& experiment,
                                               const std::string& reference,
                                               const std::vector<std::string>& metrics) {
  const std::vector<Contender> contenders = ContendersOf(experiment);
  const std::string where = experiment.folder.string();
  if (contenders.size() < 2) {
    throw ConfigError(fmt::format("{}: {} variant has finished runs; expected two at least", where,
                                  contenders.empty() ? "no" : "only one"));
  }
  const auto chosen = std::find_if(
      contenders.begin(), contenders.end(),
      [&](const Contender& contender) { return reference.empty() || contender.name == reference; });
  if (chosen == contenders.end()) {
    throw ConfigError(fmt::format("{}: no variant \"{}\"; there are: {}", where, reference,
                                  fmt::join(NamesOf(contenders), ", ")));
  }
  std::vector<PairedRuns> all;
  for (const Contender& contender : contenders) {
    if (&contender != &*chosen) all.push_back(Paired(*chosen, contender));
  }
  return Table(all, metrics);
}

VariantTable TabulateVariants(const ReportedExperiment& experiment) {
  const std::vector<Contender> contenders = ContendersOf(experiment);
  VariantTable table{TabulatedMetrics(contenders), {}};
  for (const Contender& contender : contenders) {
    const bool is_reference = &contender == &contenders.front();
    const PairedRuns paired = Paired(contenders.front(), contender);
    VariantSummary row{contender.name, static_cast<int>(contender.runs.size()), {}};
    for (const MetricName& metric : table.metrics) {
      row.cells.push_back({SpreadOf(ValuesOf(contender, metric.key)), std::nullopt});
      if (is_reference) continue;
      const VariantComparison difference = Compared(paired, metric.key);
      if (difference.other_spread.count > 0) row.cells.back().difference = difference;
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::vector<VariantComparison> CompareExperiments(const ReportedExperiment& reference,
                                                  const ReportedExperiment& other,
                                                  const std::vector<std::string>& metrics) {
  PairedRuns together{reference.folder.string(), other.folder.string() + ": all", {}, 0};
  std::vector<PairedRuns> all;
  const std::vector<Contender> references = ContendersByFullName(reference);
  for (const Contender& contender : ContendersByFullName(other)) {
    const auto found =
        std::find_if(references.begin(), references.end(),
                     [&](const Contender& candidate) { return candidate.name == contender.name; });
    PairedRuns paired = found == references.end()
                            ? PairedRuns{"", "", {}, static_cast<int>(contender.runs.size())}
                            : Paired(*found, contender);
    paired.reference = reference.folder.string();
    paired.other = fmt::format("{}: {}", other.folder.string(), contender.name);
    together.pairs.insert(together.pairs.end(), paired.pairs.begin(), paired.pairs.end());
    all.push_back(std::move(paired));
  }
  if (together.pairs.empty()) {
    throw ConfigError(fmt::format("{} and {}: no run of the one has its like in the other",
                                  reference.folder.string(), other.folder.string()));
  }
  together.unpaired = static_cast<int>(reference.finished().size() + other.finished().size() -
                                       2 * together.pairs.size());
  if (all.size() > 1) all.push_back(std::move(together));
  return Table(all, metrics);
}

}  // namespace vitruvia
