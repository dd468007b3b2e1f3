// What `vitruvia regress` measures, and the measuring.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/judgement.h"
#include "config/json_settings.h"

namespace vitruvia {

struct GatedExperiment {
  std::filesystem::path experiment;
  int repeats = 3;

  void Describe(Fields& fields);
};

// A file such as configs/nightly.json.
struct RegressSettings {
  std::string title, description;
  std::vector<GatedExperiment> experiments;
  GateTolerances tolerances;

  void Describe(Fields& fields);
};

// Those experiments whose name (experiment_config.h, ConfigName) contains `only`.
std::vector<GatedExperiment> Selected(const RegressSettings& settings, const std::string& only);

// Carries out every repeat of every experiment anew, below `folder`/repeat-N/, one run after the
// other: repeats of one experiment are apart in time, so that a slow minute of the machine meets
// one of them only. Sequences and learnt models are kept in `shared`. Pictures are not drawn.
//
// With a `baseline_program` (else empty) each repeat is also carried out by that program, with its
// own `run` command, below `folder`/baseline/: this program first in odd repeats, the baseline's
// first in even ones.
void MeasureRepeats(const std::vector<GatedExperiment>& experiments,
                    const std::filesystem::path& folder, const std::filesystem::path& shared,
                    const std::filesystem::path& baseline_program);

// The numbers of all repeats as they lie there. A run that failed or is missing in any repeat is a
// failure. DataError if a record is damaged or an experiment has not been measured.
MeasuredRuns ReadRepeats(const std::vector<GatedExperiment>& experiments,
                         const std::filesystem::path& folder);

// The same of the baseline's program. `problem` says why where its runs are not there, failed or
// cannot be read.
SpeedReference ReadReference(const std::vector<GatedExperiment>& experiments,
                             const std::filesystem::path& folder);

}  // namespace vitruvia
