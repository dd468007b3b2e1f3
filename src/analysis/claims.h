// A paper's claims, decided by run records.
#pragma once

#include <string>
#include <vector>

#include "analysis/experiment_runs.h"
#include "config/settings.h"

namespace vitruvia {

// How the records are held against a claim.
enum class ClaimRelation {
  kBound,   // the mean of the metric over the runs keeps a bound
  kBetter,  // the one contender is better than the other, over pairs of runs
  kAlike,   // the two differ by no more than a margin, over pairs of runs
};

struct ClaimTest {
  std::string metric;
  ClaimRelation relation = ClaimRelation::kBound;
  std::string of, against;          // patterns of "method/variant"
  std::vector<std::string> scenes;  // patterns; empty: all
  double at_most = kAbsent, at_least = kAbsent, margin = kAbsent, paper = kAbsent;
  std::string remark;

  void Describe(Fields& fields);
  std::string Problem() const;
};

enum class ClaimVerdict { kHolds, kDoesNotHold, kCannotBeTested };
const char* Name(ClaimVerdict verdict);  // "holds", "does not hold here", "cannot be tested here"

struct ClaimFinding {
  std::string statement;        // what is tested, with the bound
  std::string published, ours;  // printed, with unit; "–" where there is no number
  ClaimVerdict verdict = ClaimVerdict::kCannotBeTested;
  std::string reason;  // what it fails by, or why it cannot be tested; "" if it holds
};

// Over the finished runs of all these experiments. A pair shares experiment, scene, seed and
// repeat; where several runs of `against` do, the one of the same method or else of the same
// variant. What counts as a difference says paired_comparison.h; fewer pairs than FewestPairs test
// nothing.
ClaimFinding Decide(const ClaimTest& test, const std::vector<ReportedExperiment>& experiments);

struct ClaimDecision {
  ClaimVerdict verdict = ClaimVerdict::kCannotBeTested;
  // Which of the tests fail and by what, or why it cannot be tested; "" if it holds.
  std::string reason;
  std::vector<ClaimFinding> findings;
};
// A claim holds if all of its tests hold, and does not if one does not. Without tests, and where a
// test has no records to go by, it cannot be tested.
ClaimDecision Decide(const std::vector<ClaimTest>& tests,
                     const std::vector<ReportedExperiment>& experiments);

}  // namespace vitruvia
