// Tests of a paper's claims on run records.
#pragma once

#include <string>
#include <vector>

#include "analysis/experiment_runs.h"
#include "config/settings.h"

namespace vitruvia {

// How a claim is tested on the records.
enum class ClaimRelation {
  kBound,   // the mean of the metric over the runs is within a bound
  kBetter,  // one contender is better than the other, over pairs of runs
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

// Uses the finished runs of all these experiments. The runs of a pair share experiment, scene, seed
// and repeat; if several runs of `against` match, the one with the same method, or else the same
// variant, is taken. What counts as a difference says paired_comparison.h; with fewer pairs than
// FewestPairs the claim cannot be tested.
ClaimFinding Decide(const ClaimTest& test, const std::vector<ReportedExperiment>& experiments);

struct ClaimDecision {
  ClaimVerdict verdict = ClaimVerdict::kCannotBeTested;
  // Which of the tests fail and by what, or why it cannot be tested; "" if it holds.
  std::string reason;
  std::vector<ClaimFinding> findings;
};
// A claim holds if all of its tests hold, and does not hold if one of them does not. It cannot be
// tested without tests, or if a test has no records.
ClaimDecision Decide(const std::vector<ClaimTest>& tests,
                     const std::vector<ReportedExperiment>& experiments);

}  // namespace vitruvia
