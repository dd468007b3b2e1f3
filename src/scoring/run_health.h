// Whether a run kept its footing: numbers that are none, rotations that are none, energies that
// rose, frames lost and found again.
#pragma once

#include "records/run_record.h"

namespace vitruvia {

// Adds to the row, from the record's frames: frames_lost, frames_to_recover (both only where the
// true surface is known), non_finite, condition_max, rotation_drift_max, energy_mean (of all terms
// together, where there are any) and, where steps were watched, energy_rises (frames) and
// energy_rise_max (share).
void SummarizeHealth(const RunRecord& record, nlohmann::json& row);

}  // namespace vitruvia
