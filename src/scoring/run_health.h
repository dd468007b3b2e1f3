// Numerical and loss diagnostics of a run: infinite values, condition, drift, energies, lost
// frames.
#pragma once

#include "records/run_record.h"

namespace vitruvia {

// Adds the following to the row, each only if the record's frames hold the series that it needs:
//   frames_lost, frames_to_recover, frames_to_notice   where the true surface is known
//   non_finite                       number of infinite values in all series
//   condition_max, rotation_drift_max
//   weak_directions_max, agreeing_digits_min
//   energy_mean                      sum over the terms of each term's mean over its frames
//   energy_rises, energy_rise_max    frames in which a step raised the energy; the largest share
void SummarizeHealth(const RunRecord& record, nlohmann::json& row);

}  // namespace vitruvia
