// What the regression gate found, for programs and for people.
#pragma once

#include <string>

#include "analysis/judgement.h"

namespace vitruvia {

// What a report says beside the findings.
struct GateOccasion {
  std::string name, date, commit, cpu;
  GateTolerances tolerances;
  GateBaseline baseline;
  MeasuredRuns measured;
};

nlohmann::json ToJson(const GateOccasion& occasion, const Judgement& judgement);
// JUnit XML: a case for each run and kind of number.
std::string ToJunit(const GateOccasion& occasion, const Judgement& judgement);
std::string ToMarkdown(const GateOccasion& occasion, const Judgement& judgement);

// One sentence: "accuracy regressed: 3 numbers of 1 run".
std::string Headline(const Judgement& judgement);

}  // namespace vitruvia
