// Reports of the regression gate, for programs and for users.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "analysis/judgement.h"

namespace vitruvia {

// Content of a report other than the findings.
struct GateOccasion {
  std::string name, date, commit, cpu;
  GateTolerances tolerances;
  GateBaseline baseline;
  MeasuredRuns measured;
  SpeedReference reference;
};

// regression.json.
struct RegressionFile {
  static constexpr StoredFormat kFormat{"vitruvia-regression", 2, 2, "run the gate again"};

  struct BaselineEntry {
    std::string commit, date, cpu;
    void Describe(Fields& fields);
  };
  struct FindingEntry : GateFinding {
    void Describe(Fields& fields);
  };

  std::string name, date, commit, cpu, verdict;
  int exit_code = 0;
  std::string speed_not_judged;
  BaselineEntry baseline;
  std::vector<FindingEntry> findings;
  std::map<std::string, std::string> failures;
  std::map<std::string, std::string> changed_settings;
  std::vector<std::string> not_in_baseline, not_measured;
  std::vector<GatedRun> runs;

  void Describe(Fields& fields);
};
RegressionFile MakeRegressionFile(const GateOccasion& occasion, const Judgement& judgement);
// JUnit XML: a case for each run and kind of number.
std::string ToJunit(const GateOccasion& occasion, const Judgement& judgement);
std::string ToMarkdown(const GateOccasion& occasion, const Judgement& judgement);

// One sentence: "accuracy regressed: 3 numbers of 1 run".
std::string Headline(const Judgement& judgement);

}  // namespace vitruvia
