// The verdict of the regression gate: measured runs against the baseline, metric by metric.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "analysis/gate_files.h"
#include "config/settings.h"
#include "core/error.h"

namespace vitruvia {

// Speed is allowed the noise of its repeats, then and now, where that is more.
struct GateTolerances {
  double accuracy = 1e-3;
  double frame_time = 0.2;
  double step_time = 0.25;
  double gated_step_share = 0.1;

  void Describe(Fields& fields);
};

enum class NumberKind { kAccuracy, kSpeed };
const char* Name(NumberKind kind);

enum class Change { kWithin, kImproved, kRegressed };
const char* Name(Change change);

// Where in the history a regression came in.
struct Blame {
  // Commits. The last good one is the baseline's where the history says nothing.
  std::string last_good, first_bad;
};

struct Finding {
  std::string run;  // GatedRun::name()
  NumberKind kind = NumberKind::kAccuracy;
  std::string metric;
  double was = 0.0, is = 0.0;
  double limit = 0.0;  // the worst value that would have passed
  Change change = Change::kWithin;
  Blame blame;  // of regressions
};

struct Judgement {
  std::vector<Finding> findings;                // every number that was held against the baseline
  std::map<std::string, std::string> failures;  // run → what went wrong; unsteady numbers too
  std::vector<std::string> unknown;             // measured, but not in the baseline
  std::vector<std::string> unmeasured;          // runs or numbers of the baseline that are no more

  std::vector<const Finding*> OfChange(Change change) const;
  std::vector<const Finding*> Regressions(NumberKind kind) const;
  // The code of the worst that happened: a failed run, then nothing measured (or less than the
  // baseline holds), then accuracy, then speed.
  ExitCode Code() const;
};

struct MeasuredRuns {
  std::vector<GatedRun> runs;
  std::map<std::string, std::string> failures;  // by a name that people can find the run under
};

// The history is what was found before, oldest first; `commit` is that of the measured build.
Judgement Judge(const GateBaseline& baseline, const MeasuredRuns& measured,
                const GateTolerances& tolerances, const std::vector<HistoryEntry>& history,
                const std::string& commit);

}  // namespace vitruvia
