// The experiments that `vitruvia regress` measures, and their measurement.
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

// Runs every repeat of every experiment again, below `folder`/repeat-N/, one run after the other.
// Repeats of one experiment are separated in time, so that a temporary slowdown of the machine
// affects only one of them. Sequences and learnt models are kept in `shared`. Pictures are not
// drawn.
//
// With a `baseline_program` (else empty) each repeat is also carried out by that program, with its
// own `run` command, below `folder`/baseline/: this program first in odd repeats, the baseline's
// first in even ones.
void MeasureRepeats(const std::vector<GatedExperiment>& experiments,
                    const std::filesystem::path& folder, const std::filesystem::path& shared,
                    const std::filesystem::path& baseline_program);

// The numbers of all repeats stored below `folder`. A run that failed or is missing in any repeat
// is a failure. DataError if a record is damaged or an experiment has not been measured.
MeasuredRuns ReadRepeats(const std::vector<GatedExperiment>& experiments,
                         const std::filesystem::path& folder);

// The same for the baseline's program. `problem` gives the reason if its runs are missing, failed
// or cannot be read.
SpeedReference ReadReference(const std::vector<GatedExperiment>& experiments,
                             const std::filesystem::path& folder);

}  // namespace vitruvia
