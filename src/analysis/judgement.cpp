#include "analysis/judgement.h"

#include <algorithm>
#include <cmath>

#include "math/statistics.h"
#include "metrics/catalogue.h"

namespace vitruvia {
namespace {

// Lower bound of accuracy values, for numbers that are 0 up to rounding.
constexpr double kSmallestAccuracy = 1e-12;

// Bounds of a number that passes without improvement.
struct Limits {
  double worst = 0.0;  // that still passes
  double best = 0.0;   // the best value that is not yet an improvement
};

Limits AccuracyLimits(const std::string& metric, double was, double tolerance) {
  const double allowed = std::max(tolerance * std::abs(was), kSmallestAccuracy);
  const Better better = FindMetric(metric).better;
  if (better == Better::kNeither)
    throw DataError(
        fmt::format("baseline: {}: neither a lower nor a higher value is better", metric));
  const double sign = better == Better::kHigher ? -1.0 : 1.0;
  return {was + sign * allowed, was - sign * allowed};
}

Change ChangeOf(double is, const Limits& limits) {
  const double sign = limits.worst >= limits.best ? 1.0 : -1.0;
  if (sign * is > sign * limits.worst) return Change::kRegressed;
  if (sign * is < sign * limits.best) return Change::kImproved;
  return Change::kWithin;
}

// The value of the run's metric in a history entry; NaN if it was not measured, or with different
// settings.
double ValueThen(const HistoryEntry& entry, const GatedRun& is, const std::string& metric) {
  const GatedRun* run = FindRun(entry.runs, is.name());
  if (run == nullptr || run->config_hash != is.config_hash) return NAN;
  const auto found = run->accuracy.find(metric);
  return found == run->accuracy.end() ? NAN : found->second;
}

// Goes back from the newest entry as long as the number was bad there too.
Blame BlameFor(const GatedRun& is, const std::string& metric, const Limits& limits,
               const std::vector<HistoryEntry>& history, const std::string& commit,
               const std::string& baseline_commit) {
  Blame blame{baseline_commit, commit};
  for (auto entry = history.rbegin(); entry != history.rend(); ++entry) {
    const double value = ValueThen(*entry, is, metric);
    if (std::isnan(value)) continue;
    if (ChangeOf(value, limits) != Change::kRegressed) {
      blame.last_good = entry->commit;
      break;
    }
    blame.first_bad = entry->commit;
  }
  return blame;
}

Interval RatioInterval(const std::vector<double>& was_ms, const std::vector<double>& is_ms,
                       double confidence) {
  std::vector<double> ratios;
  for (std::size_t k = 0; k < std::min(was_ms.size(), is_ms.size()); ++k) {
    ratios.push_back(is_ms[k] / was_ms[k]);
  }
  return MedianInterval(ratios, confidence);
}

// A ratio up to 1 + tolerance passes; its inverse is the limit of an improvement.
Change ChangeOf(const Interval& ratio, double tolerance) {
  if (ratio.low > 1.0 + tolerance) return Change::kRegressed;
  if (ratio.high < 1.0 / (1.0 + tolerance)) return Change::kImproved;
  return Change::kWithin;
}

// Times of steps that are a small share of a frame are mostly noise.
bool IsGated(const std::string& name, const GatedRun& was, const GateTolerances& tolerances) {
  const auto frame = was.times_ms.find(kWholeFrame);
  if (frame == was.times_ms.end() || name == kWholeFrame) return true;
  return Quantile(was.times_ms.at(name), 0.5) >=
         tolerances.gated_step_share * Quantile(frame->second, 0.5);
}

// Failures go by the run's id, which is its name and a hash.
bool HasFailed(const MeasuredRuns& measured, const std::string& run_name) {
  return std::any_of(measured.failures.begin(), measured.failures.end(), [&](const auto& failure) {
    return failure.first.starts_with(run_name + ".");
  });
}

class Judging {
 public:
  Judging(const GateBaseline& baseline, const GateTolerances& tolerances,
          const std::vector<HistoryEntry>& history, const std::string& commit)
      : baseline_(baseline), tolerances_(tolerances), history_(history), commit_(commit) {}

  void CompareAccuracy(const GatedRun& was, const GatedRun& is) {
    const std::vector<std::string> changed = ChangedSettings(was, is);
    if (!changed.empty()) judgement_.changed_settings[is.name()] = changed;
    for (const auto& [metric, value] : was.accuracy)
      CompareMetric(is, metric, value, changed.empty());
    if (!is.unsteady.empty()) {
      judgement_.failures[is.name()] =
          fmt::format("not the same in all repeats: {}", fmt::join(is.unsteady, ", "));
    }
  }

  void CompareSpeed(const GatedRun& was, const GatedRun& is) {
    for (const auto& [name, was_ms] : was.times_ms) {
      const auto found = is.times_ms.find(name);
      if (found == is.times_ms.end() || !IsGated(name, was, tolerances_)) continue;
      const double tolerance = name == kWholeFrame ? tolerances_.frame_time : tolerances_.step_time;
      GateFinding finding;
      finding.run = is.name();
      finding.kind = NumberKind::kSpeed;
      finding.metric = name;
      finding.was = Quantile(was_ms, 0.5);
      finding.is = Quantile(found->second, 0.5);
      finding.limit = (1.0 + tolerance) * finding.was;
      finding.ratio = RatioInterval(was_ms, found->second, tolerances_.confidence);
      finding.change = ChangeOf(finding.ratio, tolerance);
      judgement_.findings.push_back(std::move(finding));
    }
  }

  Judgement& judgement() { return judgement_; }

 private:
  void CompareMetric(const GatedRun& is, const std::string& metric, double was,
                     bool has_same_settings) {
    const auto found = is.accuracy.find(metric);
    if (found == is.accuracy.end()) {
      judgement_.unmeasured.push_back(fmt::format("{}: {}", is.name(), metric));
      return;
    }
    const Limits limits = AccuracyLimits(metric, was, tolerances_.accuracy);
    GateFinding finding;
    finding.run = is.name();
    finding.metric = metric;
    finding.was = was;
    finding.is = found->second;
    finding.limit = limits.worst;
    finding.change = ChangeOf(finding.is, limits);
    if (finding.change == Change::kRegressed && has_same_settings)
      finding.blame = BlameFor(is, metric, limits, history_, commit_, baseline_.commit);
    judgement_.findings.push_back(std::move(finding));
  }

  const GateBaseline& baseline_;
  const GateTolerances& tolerances_;
  const std::vector<HistoryEntry>& history_;
  const std::string& commit_;
  Judgement judgement_;
};

// Of the runs that both programs carried out.
int FewestRepeats(const std::vector<GatedRun>& measured, const std::vector<GatedRun>& reference) {
  int fewest = 0;
  for (const GatedRun& run : measured) {
    const GatedRun* was = FindRun(reference, run.name());
    if (was == nullptr) continue;
    const int pairs = std::min(run.repeats, was->repeats);
    fewest = fewest == 0 ? pairs : std::min(fewest, pairs);
  }
  return fewest;
}

std::string WhySpeedIsNotJudged(const MeasuredRuns& measured, const SpeedReference& reference,
                                double confidence) {
  if (!reference.problem.empty()) return reference.problem;
  const int pairs = FewestRepeats(measured.runs, reference.runs);
  if (pairs == 0) return "the baseline's program carried out none of the measured runs";
  if (pairs >= FewestPairs(confidence)) return "";
  return fmt::format("{} repeats; at a confidence of {:g} % a change needs {}", pairs,
                     1e2 * confidence, FewestPairs(confidence));
}

}  // namespace

void GateTolerances::Describe(Fields& f) {
  f.Number("accuracy", accuracy,
           {.meaning =
                "relative tolerance by which an error may grow, or a share of found joints fall; "
                "runs are deterministic, so it only has to allow for different orders of summation",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Number("frame_time", frame_time,
           {.meaning = "relative tolerance by which the time of a frame may grow",
            .min = 0.0,
            .max = 10.0,
            .origin = Origin::kGuessed});
  f.Number("step_time", step_time,
           {.meaning = "relative tolerance by which the time of a step may grow",
            .min = 0.0,
            .max = 10.0,
            .origin = Origin::kGuessed});
  f.Number("gated_step_share", gated_step_share,
           {.meaning = "least share of a frame's time for a step to be gated separately; times of "
                       "shorter steps are mostly noise",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Number("confidence", confidence,
           {.meaning = "confidence level of the interval of a time's ratio; a change is "
                       "significant if the interval lies outside the tolerance",
            .min = 0.5,
            .max = 0.999,
            .origin = Origin::kGuessed});
}

const char* Name(NumberKind kind) { return kind == NumberKind::kAccuracy ? "accuracy" : "speed"; }

const char* Name(Change change) {
  switch (change) {
    case Change::kWithin:
      return "within tolerance";
    case Change::kImproved:
      return "improved";
    case Change::kRegressed:
      return "regressed";
  }
  return "";
}

std::vector<const GateFinding*> Judgement::OfChange(Change change) const {
  std::vector<const GateFinding*> chosen;
  for (const GateFinding& finding : findings) {
    if (finding.change == change) chosen.push_back(&finding);
  }
  return chosen;
}

std::vector<const GateFinding*> Judgement::Regressions(NumberKind kind) const {
  std::vector<const GateFinding*> chosen = OfChange(Change::kRegressed);
  std::erase_if(chosen, [kind](const GateFinding* finding) { return finding->kind != kind; });
  return chosen;
}

ExitCode Judgement::Code() const {
  if (!failures.empty()) return ExitCode::kFailedRun;
  if (findings.empty() || !unmeasured.empty()) return ExitCode::kNothingMeasured;
  if (!Regressions(NumberKind::kAccuracy).empty()) return ExitCode::kAccuracyRegressed;
  if (!Regressions(NumberKind::kSpeed).empty()) return ExitCode::kSpeedRegressed;
  return ExitCode::kSuccess;
}

Judgement Judge(const GateBaseline& baseline, const MeasuredRuns& measured,
                const SpeedReference& reference, const GateTolerances& tolerances,
                const std::vector<HistoryEntry>& history, const std::string& commit) {
  Judging judging(baseline, tolerances, history, commit);
  Judgement& judgement = judging.judgement();
  judgement.failures = measured.failures;
  judgement.speed_not_judged = WhySpeedIsNotJudged(measured, reference, tolerances.confidence);
  for (const GatedRun& run : measured.runs) {
    if (const GatedRun* was = FindRun(baseline.runs, run.name())) {
      judging.CompareAccuracy(*was, run);
    } else {
      judgement.unknown.push_back(run.name());
    }
    const GatedRun* was = FindRun(reference.runs, run.name());
    if (was != nullptr && judgement.speed_not_judged.empty()) judging.CompareSpeed(*was, run);
  }
  for (const GatedRun& was : baseline.runs) {
    if (FindRun(measured.runs, was.name()) == nullptr && !HasFailed(measured, was.name())) {
      judgement.unmeasured.push_back(was.name());
    }
  }
  return judgement;
}

}  // namespace vitruvia
