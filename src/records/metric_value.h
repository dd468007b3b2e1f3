// The values of a run's metrics (metrics/catalogue.h).
#pragma once

#include <string>

#include "metrics/catalogue.h"
#include "records/run_record.h"

namespace vitruvia {

// The time of the calibration kernel in the run's process, ms; NaN in records without it.
double CalibrationOf(const RunRecord& run);

// The metric's stored number (in the summary row, of a joint or of a step), or the number computed
// from the record (kCalibratedTime). NaN if the run has none.
double MetricValue(const RunRecord& run, const Metric& metric);
// The same by key; ConfigError if the catalogue does not have the key.
double MetricValue(const RunRecord& run, const std::string& key);

// Which repetition of its run this is, from 1.
int RepeatOf(const RunRecord& run);

}  // namespace vitruvia
