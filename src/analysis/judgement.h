// The verdict of the regression gate: measured runs against the baseline, metric by metric.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "analysis/gate_files.h"
#include "analysis/paired_comparison.h"
#include "config/settings.h"
#include "config/stored_data.h"
#include "core/error.h"

namespace vitruvia {

struct GateTolerances {
  double accuracy = 1e-3;
  double frame_time = 0.05;
  double step_time = 0.05;
  double gated_step_share = 0.1;
  double confidence = 0.95;

  void Describe(Fields& fields);
};

enum class NumberKind { kAccuracy, kSpeed };
const char* Name(NumberKind kind);

enum class Change { kWithin, kImproved, kRegressed };
const char* Name(Change change);

// The commits between which a regression of accuracy appeared. Times of other sessions, and history
// entries and baselines with different settings, are not used.
struct Blame {
  // Commits. The last good one is the baseline's if the history has none. Both are "" if the
  // settings differ from the baseline's, because then the code need not be the cause.
  std::string last_good, first_bad;
};

struct GateFinding {
  std::string run;  // GatedRun::name()
  NumberKind kind = NumberKind::kAccuracy;
  std::string metric;
  // Accuracy: the baseline's value and the measured one. Speed: the medians over the repeats of the
  // baseline's program and of the measured program, ms.
  double was = 0.0, is = 0.0;
  double limit = 0.0;  // the worst value that would have passed
  // Speed: confidence interval of the median of is / was over the pairs of repeats. Accuracy: NaN.
  Interval ratio = {kAbsent, kAbsent};
  Change change = Change::kWithin;
  Blame blame;  // of regressions
};

struct Judgement {
  std::vector<GateFinding> findings;            // every number that was compared with the baseline
  std::map<std::string, std::string> failures;  // run → problem, including unsteady numbers
  std::vector<std::string> unknown;             // measured, but not in the baseline
  std::vector<std::string> unmeasured;          // runs or numbers of the baseline that were not
                                                // measured
  // Run → differences between the baseline's settings and its own (ChangedSettings).
  std::map<std::string, std::vector<std::string>> changed_settings;
  std::string speed_not_judged;  // "" or the reason why no time was compared

  std::vector<const GateFinding*> OfChange(Change change) const;
  std::vector<const GateFinding*> Regressions(NumberKind kind) const;
  // The exit code of the most severe outcome: first a failed run, then missing measurements, then
  // accuracy, then speed.
  ExitCode Code() const;
};

struct MeasuredRuns {
  std::vector<GatedRun> runs;
  std::map<std::string, std::string> failures;  // by a name that identifies the run to the user
};

// The same runs by the baseline's program on the same machine in the same session: its k-th repeat
// ran next to the k-th repeat of the measured program.
struct SpeedReference {
  std::vector<GatedRun> runs;
  std::string commit;   // of that program
  std::string problem;  // "" or why there are no runs
};

// Compares accuracy with the baseline, and speed with the reference: a time has changed only if the
// interval of the median ratio of its pairs lies outside the tolerance. `history`: earlier results,
// oldest first; `commit`: that of the measured build.
Judgement Judge(const GateBaseline& baseline, const MeasuredRuns& measured,
                const SpeedReference& reference, const GateTolerances& tolerances,
                const std::vector<HistoryEntry>& history, const std::string& commit);

}  // namespace vitruvia
