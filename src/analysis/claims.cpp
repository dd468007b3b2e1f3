#include "analysis/claims.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/paired_differences.h"
#include "analysis/printed_metric.h"
#include "core/error.h"
#include "core/pattern.h"
#include "math/statistics.h"
#include "records/metric_value.h"

namespace vitruvia {
namespace {

using RunList = std::vector<const RunRecord*>;

RunList RunsOf(const std::string& contender, const ClaimTest& test,
               const ReportedExperiment& experiment) {
  RunList runs = experiment.finished();
  std::erase_if(runs, [&](const RunRecord* run) {
    return !MatchesPattern(contender, ContenderOf(*run)) || !MatchesAny(test.scenes, run->scene);
  });
  return runs;
}

bool AreOfOneSequence(const RunRecord& a, const RunRecord& b) {
  return a.scene == b.scene && a.seed == b.seed && RepeatOf(a) == RepeatOf(b);
}

// The partner of a run; of several candidates, the one with the same method, or else the same
// variant. Null if there is none or if the choice is ambiguous.
const RunRecord* PartnerOf(const RunRecord& run, const RunList& candidates) {
  RunList partners;
  for (const RunRecord* candidate : candidates) {
    if (AreOfOneSequence(run, *candidate)) partners.push_back(candidate);
  }
  for (std::string RunRecord::*const key : {&RunRecord::method, &RunRecord::variant}) {
    RunList same;
    for (const RunRecord* partner : partners) {
      if (partner->*key == run.*key) same.push_back(partner);
    }
    if (!same.empty()) partners = same;
  }
  return partners.size() == 1 ? partners.front() : nullptr;
}

struct PairedValues {
  std::vector<double> of, against;
  Groups differences;  // of − against, by scene
};

PairedValues PairsOf(const ClaimTest& test, const Metric& metric,
                     const std::vector<ReportedExperiment>& experiments) {
  PairedValues values;
  PairedDifferences differences;
  for (const ReportedExperiment& experiment : experiments) {
    const RunList candidates = RunsOf(test.against, test, experiment);
    for (const RunRecord* run : RunsOf(test.of, test, experiment)) {
      const RunRecord* partner = PartnerOf(*run, candidates);
      if (partner == nullptr) continue;
      const double of = MetricValue(*run, metric), against = MetricValue(*partner, metric);
      if (std::isnan(of) || std::isnan(against)) continue;
      values.of.push_back(of);
      values.against.push_back(against);
      differences.Add(*partner, *run, of - against);
    }
  }
  values.differences = differences.Grouped();
  return values;
}

std::vector<double> ValuesOf(const std::string& contender, const ClaimTest& test,
                             const Metric& metric,
                             const std::vector<ReportedExperiment>& experiments) {
  std::vector<double> values;
  for (const ReportedExperiment& experiment : experiments) {
    for (const RunRecord* run : RunsOf(contender, test, experiment)) {
      const double value = MetricValue(*run, metric);
      if (!std::isnan(value)) values.push_back(value);
    }
  }
  return values;
}

std::string WithUnit(const std::string& number, const Metric& metric) {
  return metric.unit.empty() ? number : number + " " + metric.unit;
}

std::string OnScenes(const ClaimTest& test) {
  return test.scenes.empty() ? "" : fmt::format(", on {}", fmt::join(test.scenes, ", "));
}

std::string StatementOf(const ClaimTest& test, const Metric& metric) {
  switch (test.relation) {
    case ClaimRelation::kBound: {
      const bool is_upper = !std::isnan(test.at_most);
      return fmt::format(
          "{}: {}{} {} {}", metric.label, test.of, OnScenes(test), is_upper ? "≤" : "≥",
          WithUnit(Printed(is_upper ? test.at_most : test.at_least, metric), metric));
    }
    case ClaimRelation::kBetter:
      return fmt::format("{}: {} better than {}{}", metric.label, test.of, test.against,
                         OnScenes(test));
    case ClaimRelation::kAlike:
      return fmt::format("{}: {} and {}{} differ by at most {}", metric.label, test.of,
                         test.against, OnScenes(test),
                         WithUnit(Printed(test.margin, metric), metric));
  }
  return "";
}

void DecideBound(const ClaimTest& test, const Metric& metric,
                 const std::vector<ReportedExperiment>& experiments, ClaimFinding& finding) {
  const std::vector<double> values = ValuesOf(test.of, test, metric, experiments);
  if (values.empty()) {
    finding.reason = fmt::format("no run of {} has {}", test.of, metric.key);
    return;
  }
  const double mean = Mean(values);
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  finding.ours = WithUnit(Printed(mean, metric), metric);
  if (values.size() > 1) {
    finding.ours += fmt::format(" ({} … {}, {} runs)", Printed(*least, metric),
                                Printed(*most, metric), values.size());
  }
  const bool is_upper = !std::isnan(test.at_most);
  const double excess = is_upper ? mean - test.at_most : test.at_least - mean;
  finding.verdict = excess <= 0.0 ? ClaimVerdict::kHolds : ClaimVerdict::kDoesNotHold;
  if (excess > 0.0) {
    finding.reason = fmt::format("{} the bound by {}", is_upper ? "above" : "below",
                                 WithUnit(Printed(excess, metric), metric));
  }
}

// Why the difference is not shown to be one for the better; "" if it is.
std::string NotBetter(const PairedComparison& comparison, const Metric& metric) {
  const bool higher_is_better = metric.better == Better::kHigher;
  if (comparison.verdict == (higher_is_better ? Difference::kHigher : Difference::kLower))
    return "";
  const Interval& interval = comparison.interval;
  if (interval.low <= 0.0 && interval.high >= 0.0) return "the interval holds 0";
  if (higher_is_better ? interval.high < 0.0 : interval.low > 0.0) return "it is worse";
  return fmt::format("the interval is clear of 0, but p = {:.2f} by Student's test over {} {}",
                     comparison.p, comparison.unit_difference.count,
                     comparison.scenes > 1 ? "scenes" : "pairs");
}

std::string NotWithin(const Interval& interval, double margin) {
  return interval.low >= -margin && interval.high <= margin ? "" : "the interval leaves the margin";
}

void DecidePairs(const ClaimTest& test, const Metric& metric,
                 const std::vector<ReportedExperiment>& experiments, ClaimFinding& finding) {
  const PairedValues values = PairsOf(test, metric, experiments);
  if (values.of.empty()) {
    const bool has_runs = !ValuesOf(test.against, test, metric, experiments).empty();
    finding.reason = has_runs ? fmt::format("no run of {} has a partner", test.of)
                              : fmt::format("no run of {} has {}", test.against, metric.key);
    return;
  }
  const PairedComparison comparison = ComparePairs(values.differences);
  const int pairs = comparison.difference.count;
  finding.ours = fmt::format("{} against {}", Printed(Mean(values.of), metric),
                             WithUnit(Printed(Mean(values.against), metric), metric));
  const int fewest = FewestPairs(BootstrapSettings{}.confidence);
  if (pairs < fewest) {
    finding.reason = fmt::format("{} pairs, and fewer than {} decide nothing", pairs, fewest);
    return;
  }
  finding.ours += fmt::format(", difference {} [{} … {}], {} pairs",
                              PrintedSigned(comparison.difference.mean, metric),
                              PrintedSigned(comparison.interval.low, metric),
                              PrintedSigned(comparison.interval.high, metric), pairs);
  finding.reason = test.relation == ClaimRelation::kBetter
                       ? NotBetter(comparison, metric)
                       : NotWithin(comparison.interval, test.margin);
  finding.verdict = finding.reason.empty() ? ClaimVerdict::kHolds : ClaimVerdict::kDoesNotHold;
}

std::string BoundProblem(const ClaimTest& test) {
  if (!test.against.empty() || !std::isnan(test.margin))
    return "relation bound: expected neither \"against\" nor \"margin\"";
  if (std::isnan(test.at_most) == std::isnan(test.at_least))
    return "relation bound: expected one of at_most and at_least";
  return "";
}

std::string PairProblem(const ClaimTest& test, const char* relation) {
  if (test.against.empty()) return fmt::format("relation {}: expected \"against\"", relation);
  if (!std::isnan(test.at_most) || !std::isnan(test.at_least))
    return fmt::format("relation {}: expected neither at_most nor at_least", relation);
  return "";
}

int Count(const std::vector<ClaimFinding>& findings, ClaimVerdict verdict) {
  return static_cast<int>(
      std::count_if(findings.begin(), findings.end(),
                    [verdict](const ClaimFinding& f) { return f.verdict == verdict; }));
}

// Of the findings with that verdict.
std::string Reasons(const std::vector<ClaimFinding>& findings, ClaimVerdict verdict) {
  std::vector<std::string> reasons;
  for (const ClaimFinding& finding : findings) {
    if (finding.verdict == verdict)
      reasons.push_back(fmt::format("{} ({})", finding.statement, finding.reason));
  }
  return fmt::format("{}", fmt::join(reasons, "; "));
}

}  // namespace

void ClaimTest::Describe(Fields& f) {
  f.Text("metric", metric, {.meaning = "key of a metric (vitruvia explain)", .required = true});
  f.Choice("relation", relation,
           {{"bound", ClaimRelation::kBound},
            {"better", ClaimRelation::kBetter},
            {"alike", ClaimRelation::kAlike}},
           {.meaning = "condition of the test: the mean over the runs is within a bound; or, over "
                       "pairs of runs, one contender is better than the other; or the two differ "
                       "by no more than a margin"});
  f.Text("of", of,
         {.meaning = "contender whose runs are tested: pattern (* ? [abc]) of \"method/variant\"",
          .required = true});
  f.Text("against", against,
         {.meaning = "the contender that pairs are made with: pattern of \"method/variant\""});
  f.Texts("scenes", scenes,
          {.meaning = "patterns of the scenes that the test is about; all if empty"});
  f.Number("at_most", at_most, {.meaning = "upper bound of the mean over the runs"});
  f.Number("at_least", at_least, {.meaning = "lower bound of the mean over the runs"});
  f.Number("margin", margin,
           {.meaning = "largest difference at which two contenders count as equal", .min = 0.0});
  f.Number("paper", paper, {.meaning = "value of the metric that the paper prints"});
  f.Text("remark", remark,
         {.meaning = "origin of a bound or margin that the paper does not print, and differences "
                     "from the paper's test"});
}

std::string ClaimTest::Problem() const {
  if (std::string problem = UnknownMetricProblem(metric); !problem.empty()) return problem;
  if (relation == ClaimRelation::kBound) return BoundProblem(*this);
  if (relation == ClaimRelation::kAlike) {
    if (std::isnan(margin)) return "relation alike: expected \"margin\"";
    return PairProblem(*this, "alike");
  }
  if (FindMetric(metric).better == Better::kNeither)
    return fmt::format("relation better: {} has no better direction", metric);
  if (!std::isnan(margin)) return "relation better: expected no \"margin\"";
  return PairProblem(*this, "better");
}

const char* Name(ClaimVerdict verdict) {
  switch (verdict) {
    case ClaimVerdict::kHolds:
      return "holds";
    case ClaimVerdict::kDoesNotHold:
      return "does not hold here";
    case ClaimVerdict::kCannotBeTested:
      return "cannot be tested here";
  }
  return "";
}

ClaimFinding Decide(const ClaimTest& test, const std::vector<ReportedExperiment>& experiments) {
  const Metric metric = FindMetric(test.metric);
  ClaimFinding finding;
  finding.statement = StatementOf(test, metric);
  finding.published =
      std::isnan(test.paper) ? kNoNumber : WithUnit(Printed(test.paper, metric), metric);
  finding.ours = kNoNumber;
  if (test.relation == ClaimRelation::kBound) {
    DecideBound(test, metric, experiments, finding);
  } else {
    DecidePairs(test, metric, experiments, finding);
  }
  return finding;
}

ClaimDecision Decide(const std::vector<ClaimTest>& tests,
                     const std::vector<ReportedExperiment>& experiments) {
  ClaimDecision decision;
  if (tests.empty()) {
    decision.reason = "no test decides on it";
    return decision;
  }
  using enum ClaimVerdict;
  for (const ClaimTest& test : tests) decision.findings.push_back(Decide(test, experiments));
  decision.verdict = kHolds;
  for (const ClaimVerdict worse : {kCannotBeTested, kDoesNotHold}) {
    if (Count(decision.findings, worse) > 0) decision.verdict = worse;
  }
  if (decision.verdict == kHolds) return decision;
  decision.reason = Reasons(decision.findings, decision.verdict);
  if (const int held = Count(decision.findings, kHolds); held > 0)
    decision.reason += fmt::format("; {} of {} tests hold", held, tests.size());
  return decision;
}

}  // namespace vitruvia
