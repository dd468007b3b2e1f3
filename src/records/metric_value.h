// The numbers of a run by name: those of its summary row, and those that follow from its record.
#pragma once

#include <string>

#include "records/run_record.h"

namespace vitruvia {

// The median time of a frame as a multiple of the calibration kernel's (core/calibration.h), taken
// in the same process: compares across machines.
inline constexpr const char* kCalibratedTime = "frame_median_per_calibration";

// What the calibration kernel took in the run's process, ms; NaN in records of before it.
double CalibrationOf(const RunRecord& run);

// NaN where the run has no such number.
double MetricValue(const RunRecord& run, const std::string& key);

// Shares of what was found; everything else is an error, a time or a count of failures.
bool HigherIsBetter(const std::string& key);

}  // namespace vitruvia
