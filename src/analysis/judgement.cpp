#include "analysis/judgement.h"

#include <algorithm>
#include <cmath>

#include "metrics/catalogue.h"

namespace vitruvia {
namespace {

// Of numbers that are 0 but for their rounding.
constexpr double kSmallestAccuracy = 1e-12;

// Two values on one scale: what is too high to pass, or too low.
struct Limits {
  double worst = 0.0;  // that passes
  double best = 0.0;   // that is no improvement yet
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

// A time may be as much slower as a ratio says, and the same ratio the other way is an improvement.
Limits SpeedLimits(double was, double tolerance) {
  return {was * (1.0 + tolerance), was / (1.0 + tolerance)};
}

Change ChangeOf(double is, const Limits& limits) {
  const double sign = limits.worst >= limits.best ? 1.0 : -1.0;
  if (sign * is > sign * limits.worst) return Change::kRegressed;
  if (sign * is < sign * limits.best) return Change::kImproved;
  return Change::kWithin;
}

const std::map<std::string, double>& NumbersOf(const GatedRun& run, NumberKind kind) {
  return kind == NumberKind::kAccuracy ? run.accuracy : run.speed;
}

// The value of a finding on an earlier occasion; NaN if it was not measured then.
double ValueThen(const HistoryEntry& entry, const Finding& finding) {
  for (const GatedRun& run : entry.runs) {
    if (run.name() != finding.run) continue;
    const auto& numbers = NumbersOf(run, finding.kind);
    const auto found = numbers.find(finding.metric);
    return found == numbers.end() ? NAN : found->second;
  }
  return NAN;
}

// Back from the newest entry as long as the number was bad there too.
Blame BlameFor(const Finding& finding, const Limits& limits,
               const std::vector<HistoryEntry>& history, const std::string& commit,
               const std::string& baseline_commit) {
  Blame blame{baseline_commit, commit};
  for (auto entry = history.rbegin(); entry != history.rend(); ++entry) {
    const double value = ValueThen(*entry, finding);
    if (std::isnan(value)) continue;
    if (ChangeOf(value, limits) != Change::kRegressed) {
      blame.last_good = entry->commit;
      break;
    }
    blame.first_bad = entry->commit;
  }
  return blame;
}

// The tolerance of something timed, 0 if its share of the frame is too small to be gated.
double SpeedTolerance(const GatedRun& was, const std::string& name, double ratio,
                      const GateTolerances& tolerances) {
  const auto frame = was.speed.find(kWholeFrame);
  if (frame == was.speed.end() || name == kWholeFrame) return tolerances.frame_time;
  return ratio >= tolerances.gated_step_share * frame->second ? tolerances.step_time : 0.0;
}

double NoiseOf(const GatedRun& run, const std::string& name) {
  const auto found = run.speed_noise.find(name);
  return found == run.speed_noise.end() ? 0.0 : found->second;
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

  void Compare(const GatedRun& was, const GatedRun& is) {
    for (const auto& [metric, value] : was.accuracy)
      Compare(was, is, NumberKind::kAccuracy, metric,
              AccuracyLimits(metric, value, tolerances_.accuracy));
    for (const auto& [name, value] : was.speed) {
      const double tolerance = SpeedTolerance(was, name, value, tolerances_);
      if (tolerance == 0.0) continue;
      const double noise = NoiseOf(was, name) + NoiseOf(is, name);
      Compare(was, is, NumberKind::kSpeed, name, SpeedLimits(value, std::max(tolerance, noise)));
    }
    if (!is.unsteady.empty()) {
      judgement_.failures[is.name()] =
          fmt::format("not the same in all repeats: {}", fmt::join(is.unsteady, ", "));
    }
  }

  Judgement& judgement() { return judgement_; }

 private:
  void Compare(const GatedRun& was, const GatedRun& is, NumberKind kind, const std::string& metric,
               const Limits& limits) {
    const auto found = NumbersOf(is, kind).find(metric);
    if (found == NumbersOf(is, kind).end()) {
      judgement_.unmeasured.push_back(fmt::format("{}: {}", is.name(), metric));
      return;
    }
    Finding finding{is.name(),     kind,         metric,          NumbersOf(was, kind).at(metric),
                    found->second, limits.worst, Change::kWithin, {}};
    finding.change = ChangeOf(finding.is, limits);
    if (finding.change == Change::kRegressed)
      finding.blame = BlameFor(finding, limits, history_, commit_, baseline_.commit);
    judgement_.findings.push_back(std::move(finding));
  }

  const GateBaseline& baseline_;
  const GateTolerances& tolerances_;
  const std::vector<HistoryEntry>& history_;
  const std::string& commit_;
  Judgement judgement_;
};

}  // namespace

void GateTolerances::Describe(Fields& f) {
  f.Number("accuracy", accuracy,
           {.meaning = "by how much of itself an error may grow, or a share of joints found fall: "
                       "runs are deterministic, so this allows for other orders of summation only",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Number("frame_time", frame_time,
           {.meaning = "by how much of itself the calibrated time of a frame may grow",
            .min = 0.0,
            .max = 10.0,
            .origin = Origin::kGuessed});
  f.Number("step_time", step_time,
           {.meaning = "by how much of itself the calibrated time of a step may grow",
            .min = 0.0,
            .max = 10.0,
            .origin = Origin::kGuessed});
  f.Number("gated_step_share", gated_step_share,
           {.meaning = "the share of a frame's time from which a step is gated on its own: shorter "
                       "ones are mostly the clock's noise",
            .min = 0.0,
            .max = 1.0,
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

std::vector<const Finding*> Judgement::OfChange(Change change) const {
  std::vector<const Finding*> chosen;
  for (const Finding& finding : findings) {
    if (finding.change == change) chosen.push_back(&finding);
  }
  return chosen;
}

std::vector<const Finding*> Judgement::Regressions(NumberKind kind) const {
  std::vector<const Finding*> chosen = OfChange(Change::kRegressed);
  std::erase_if(chosen, [kind](const Finding* finding) { return finding->kind != kind; });
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
                const GateTolerances& tolerances, const std::vector<HistoryEntry>& history,
                const std::string& commit) {
  Judging judging(baseline, tolerances, history, commit);
  Judgement& judgement = judging.judgement();
  judgement.failures = measured.failures;
  for (const GatedRun& run : measured.runs) {
    if (const GatedRun* was = baseline.Find(run.name())) {
      judging.Compare(*was, run);
    } else {
      judgement.unknown.push_back(run.name());
    }
  }
  for (const GatedRun& was : baseline.runs) {
    const bool is_there =
        std::any_of(measured.runs.begin(), measured.runs.end(),
                    [&](const GatedRun& run) { return run.name() == was.name(); });
    if (!is_there && !HasFailed(measured, was.name())) judgement.unmeasured.push_back(was.name());
  }
  return judgement;
}

}  // namespace vitruvia
