#include "analysis/variant_comparison.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "analysis/paired_differences.h"
#include "analysis/swept_settings.h"
#include "core/error.h"
#include "records/metric_value.h"

namespace vitruvia {
namespace {

struct RunPair {
  const RunRecord* reference;
  const RunRecord* other;
};
struct PairedRuns {
  std::string reference, other;
  std::vector<RunPair> pairs;
  int unpaired = 0;
};

// The key that the two runs of a pair have in common.
std::string PairKey(const RunRecord& run) {
  return fmt::format("{}\n{}\n{}", run.scene, run.seed, RepeatOf(run));
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

bool BothHave(const RunPair& pair, const Metric& metric) {
  return !std::isnan(MetricValue(*pair.reference, metric)) &&
         !std::isnan(MetricValue(*pair.other, metric));
}

bool IsZeroInBoth(const RunPair& pair, const Metric& metric) {
  return MetricValue(*pair.reference, metric) == 0.0 && MetricValue(*pair.other, metric) == 0.0;
}

bool SomePairHas(const std::vector<RunPair>& pairs, const Metric& metric) {
  return std::any_of(pairs.begin(), pairs.end(),
                     [&](const RunPair& pair) { return BothHave(pair, metric); });
}

// The metrics of `keys` that some pair has.
std::vector<Metric> MetricsOf(const std::vector<RunPair>& pairs,
                              const std::vector<std::string>& keys) {
  std::vector<Metric> metrics;
  for (const std::string& key : keys) metrics.push_back(FindMetric(key));
  std::erase_if(metrics, [&](const Metric& metric) { return !SomePairHas(pairs, metric); });
  return metrics;
}

// The metrics of Place::kComparison that some pair has and that are not 0 in all runs.
std::vector<Metric> UsualMetrics(const std::vector<RunPair>& pairs) {
  std::vector<Metric> metrics = MetricsShownIn(Place::kComparison);
  std::erase_if(metrics, [&](const Metric& metric) {
    return !SomePairHas(pairs, metric) ||
           std::all_of(pairs.begin(), pairs.end(),
                       [&](const RunPair& pair) { return IsZeroInBoth(pair, metric); });
  });
  return metrics;
}

std::vector<Metric> MetricsToCompare(const std::vector<RunPair>& pairs,
                                     const std::vector<std::string>& asked,
                                     const ExperimentRecord& experiment) {
  std::vector<Metric> metrics;
  if (asked.empty()) {
    metrics = MetricsOf(pairs, experiment.table_columns);
    return metrics.empty() ? UsualMetrics(pairs) : metrics;
  }
  for (const std::string& key : asked) {
    if (std::count(asked.begin(), asked.end(), key) > 1)  // Holm's correction would count it twice
      throw ConfigError(fmt::format("metric \"{}\": asked for twice", key));
    metrics.push_back(FindMetric(key));
    if (!SomePairHas(pairs, metrics.back()))
      throw ConfigError(fmt::format("metric \"{}\": no pair of runs has it", key));
  }
  return metrics;
}

VariantComparison Compared(const PairedRuns& paired, const Metric& metric) {
  VariantComparison row{metric, paired.reference, paired.other, paired.unpaired, {}, {}, {}};
  std::vector<double> reference, other;
  PairedDifferences differences;
  for (const RunPair& pair : paired.pairs) {
    const double a = MetricValue(*pair.reference, metric), b = MetricValue(*pair.other, metric);
    if (std::isnan(a) || std::isnan(b)) {
      row.unpaired += 2;
      continue;
    }
    reference.push_back(a);
    other.push_back(b);
    differences.Add(*pair.reference, *pair.other, b - a);
  }
  if (other.empty()) return row;
  row.reference_spread = SpreadOf(reference);
  row.other_spread = SpreadOf(other);
  row.comparison = ComparePairs(differences.Grouped());
  return row;
}

void AdjustTogether(const std::vector<VariantComparison*>& rows) {
  std::vector<PairedComparison*> comparisons;
  for (VariantComparison* row : rows) comparisons.push_back(&row->comparison);
  AdjustByHolm(comparisons, BootstrapSettings{}.confidence);
}

std::vector<VariantComparison> Table(const std::vector<PairedRuns>& all,
                                     const std::vector<std::string>& asked,
                                     const ExperimentRecord& experiment) {
  std::vector<RunPair> pairs;
  for (const PairedRuns& paired : all)
    pairs.insert(pairs.end(), paired.pairs.begin(), paired.pairs.end());
  std::vector<VariantComparison> rows;
  for (const Metric& metric : MetricsToCompare(pairs, asked, experiment)) {
    for (const PairedRuns& paired : all) {
      const VariantComparison row = Compared(paired, metric);
      if (row.other_spread.count > 0) rows.push_back(row);
    }
  }
  std::vector<VariantComparison*> together;
  for (VariantComparison& row : rows) together.push_back(&row);
  AdjustTogether(together);
  return rows;
}

std::vector<std::string> NamesOf(const std::vector<Contender>& contenders) {
  std::vector<std::string> names;
  for (const Contender& contender : contenders) names.push_back(contender.name);
  return names;
}

// By full names, so that two folders agree on them.
std::vector<Contender> ContendersByContenderOf(const ReportedExperiment& experiment) {
  std::vector<Contender> contenders;
  for (const RunRecord* run : experiment.finished()) {
    const std::string name = ContenderOf(*run);
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

std::vector<double> ValuesOf(const Contender& contender, const Metric& metric) {
  std::vector<double> values;
  for (const RunRecord* run : contender.runs) {
    const double value = MetricValue(*run, metric);
    if (!std::isnan(value)) values.push_back(value);
  }
  return values;
}

bool IsZeroInAll(const std::vector<Contender>& contenders, const Metric& metric) {
  return std::all_of(contenders.begin(), contenders.end(), [&](const Contender& contender) {
    const std::vector<double> values = ValuesOf(contender, metric);
    return std::all_of(values.begin(), values.end(), [](double value) { return value == 0.0; });
  });
}

// Means of counts are printed with a decimal.
std::vector<Metric> TabulatedMetrics(const std::vector<Contender>& contenders,
                                     const ExperimentRecord& experiment) {
  std::vector<Metric> metrics;
  for (const std::string& key : experiment.table_columns) metrics.push_back(FindMetric(key));
  if (experiment.table_columns.empty()) {
    metrics = MetricsShownIn(Place::kVariantTable);
    std::erase_if(metrics, [&](const Metric& metric) { return IsZeroInAll(contenders, metric); });
    for (const FrameSummary& summary : experiment.summaries)
      metrics.push_back(FindMetric("summary[" + summary.name + "]"));
  }
  for (Metric& metric : metrics) metric.decimals = std::max(metric.decimals, 1);
  return metrics;
}

std::vector<SampleSpread> SpreadsOf(const std::vector<Contender>& contenders,
                                    const Metric& metric) {
  std::vector<SampleSpread> spreads;
  for (const Contender& contender : contenders)
    spreads.push_back(SpreadOf(ValuesOf(contender, metric)));
  return spreads;
}

// Indices of the best and the second best mean; nothing if there are no two, or none is better.
std::optional<std::pair<std::size_t, std::size_t>> BestTwo(const std::vector<Contender>& contenders,
                                                           const Metric& metric) {
  const std::vector<SampleSpread> spreads = SpreadsOf(contenders, metric);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < spreads.size(); ++i) {
    if (spreads[i].count > 0) order.push_back(i);
  }
  if (order.size() < 2 || metric.better == Better::kNeither) return std::nullopt;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return metric.better == Better::kHigher ? spreads[a].mean > spreads[b].mean
                                            : spreads[a].mean < spreads[b].mean;
  });
  return std::pair(order[0], order[1]);
}

// The best contender of each metric whose difference from the second best is shown; nothing else.
std::vector<std::optional<std::size_t>> ShownBest(const std::vector<Contender>& contenders,
                                                  const std::vector<Metric>& metrics) {
  std::vector<std::optional<std::size_t>> best(metrics.size());
  std::vector<VariantComparison> rows(metrics.size());
  std::vector<VariantComparison*> together;
  for (std::size_t m = 0; m < metrics.size(); ++m) {
    const auto two = BestTwo(contenders, metrics[m]);
    if (!two) continue;
    rows[m] = Compared(Paired(contenders[two->second], contenders[two->first]), metrics[m]);
    if (rows[m].other_spread.count == 0) continue;
    best[m] = two->first;
    together.push_back(&rows[m]);
  }
  AdjustTogether(together);
  for (std::size_t m = 0; m < metrics.size(); ++m) {
    const Difference verdict = rows[m].comparison.verdict;
    if (verdict != Difference::kLower && verdict != Difference::kHigher) best[m].reset();
  }
  return best;
}

}  // namespace

std::vector<Contender> ContendersOf(const ReportedExperiment& experiment) {
  std::vector<Contender> contenders = ContendersByContenderOf(experiment);
  std::set<std::string> methods, variants, unswept;
  for (const Contender& contender : contenders) {
    methods.insert(contender.runs.front()->method);
    variants.insert(contender.runs.front()->variant);
    unswept.insert(UnsweptName(contender.runs.front()->variant));
  }
  for (Contender& contender : contenders) {
    const RunRecord& run = *contender.runs.front();
    const std::string variant = unswept.size() == 1 ? SweptPart(run.variant) : run.variant;
    contender.name = methods.size() == 1    ? variant
                     : variants.size() == 1 ? run.method
                                            : run.method + "/" + variant;
  }
  return contenders;
}

std::size_t DefaultContender(const ReportedExperiment& experiment,
                             const std::vector<Contender>& contenders) {
  const auto found =
      std::find_if(contenders.begin(), contenders.end(), [&](const Contender& contender) {
        return AreOthersAtDefault(*contender.runs.front(), experiment.record.sweep, nullptr);
      });
  return found == contenders.end() ? 0 : static_cast<std::size_t>(found - contenders.begin());
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
  const auto usual =
      contenders.begin() + static_cast<std::ptrdiff_t>(DefaultContender(experiment, contenders));
  const auto chosen =
      reference.empty()
          ? usual
          : std::find_if(contenders.begin(), contenders.end(), [&](const Contender& c) {
              return c.name == reference || c.runs.front()->variant == reference;
            });
  if (chosen == contenders.end()) {
    throw ConfigError(fmt::format("{}: no variant \"{}\"; there are: {}", where, reference,
                                  fmt::join(NamesOf(contenders), ", ")));
  }
  std::vector<PairedRuns> all;
  for (const Contender& contender : contenders) {
    if (&contender != &*chosen) all.push_back(Paired(*chosen, contender));
  }
  return Table(all, metrics, experiment.record);
}

VariantTable TabulateVariants(const ReportedExperiment& experiment) {
  const std::vector<Contender> contenders = ContendersOf(experiment);
  VariantTable table{"", TabulatedMetrics(contenders, experiment.record), {}};
  if (contenders.empty()) return table;
  const Contender& reference = contenders[DefaultContender(experiment, contenders)];
  table.reference = reference.name;
  const auto best = ShownBest(contenders, table.metrics);
  for (std::size_t c = 0; c < contenders.size(); ++c) {
    const Contender& contender = contenders[c];
    const PairedRuns paired = Paired(reference, contender);
    VariantSummary row{contender.name, static_cast<int>(contender.runs.size()), {}};
    for (std::size_t m = 0; m < table.metrics.size(); ++m) {
      const Metric& metric = table.metrics[m];
      row.cells.push_back({SpreadOf(ValuesOf(contender, metric)), std::nullopt, best[m] == c});
      if (&contender == &reference) continue;
      const VariantComparison difference = Compared(paired, metric);
      if (difference.other_spread.count > 0) row.cells.back().difference = difference;
    }
    table.rows.push_back(std::move(row));
  }
  std::vector<VariantComparison*> together;
  for (VariantSummary& row : table.rows) {
    for (VariantSummary::Cell& cell : row.cells) {
      if (cell.difference) together.push_back(&*cell.difference);
    }
  }
  AdjustTogether(together);
  return table;
}

VariantTable TabulateScenes(const ReportedExperiment& experiment) {
  std::vector<Contender> scenes;
  for (const RunRecord* run : experiment.finished()) {
    const auto found = std::find_if(scenes.begin(), scenes.end(),
                                    [&](const Contender& c) { return c.name == run->scene; });
    if (found == scenes.end()) {
      scenes.push_back({run->scene, {run}});
    } else {
      found->runs.push_back(run);
    }
  }
  VariantTable table{"", TabulatedMetrics(scenes, experiment.record), {}};
  for (const Contender& scene : scenes) {
    VariantSummary row{scene.name, static_cast<int>(scene.runs.size()), {}};
    for (const Metric& metric : table.metrics)
      row.cells.push_back({SpreadOf(ValuesOf(scene, metric)), std::nullopt, false});
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::vector<VariantComparison> CompareExperiments(const ReportedExperiment& reference,
                                                  const ReportedExperiment& other,
                                                  const std::vector<std::string>& metrics) {
  PairedRuns together{reference.folder.string(), other.folder.string() + ": all", {}, 0};
  std::vector<PairedRuns> all;
  const std::vector<Contender> references = ContendersByContenderOf(reference);
  for (const Contender& contender : ContendersByContenderOf(other)) {
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
  return Table(all, metrics, reference.record);
}

}  // namespace vitruvia
