// What the regression gate holds against its baseline: the numbers of one run over its repeats.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "config/stored_data.h"
#include "records/run_record.h"

namespace vitruvia {

// The speed of a whole frame, beside that of its steps.
inline constexpr const char* kWholeFrame = "frame";

// Named without the hash of its config, since a changed default must be seen as a change, not as
// another run.
struct GatedRun {
  std::string experiment, variant, scene, method;
  int seed = 0;
  int repeats = 0;
  // By metric, of the first repeat: the same in all, or `unsteady` names those that are not.
  std::map<std::string, double> accuracy;
  std::vector<std::string> unsteady;
  // By name of what was timed ("frame", a step, "fit"): its time as a multiple of the calibration
  // kernel's in the same process (core/calibration.h), the median over the repeats.
  std::map<std::string, double> speed;
  // By the same names, half the range over the repeats as a share of the median: how far the clock
  // is to be believed.
  std::map<std::string, double> speed_noise;
  double calibration_ms = 0.0;  // median over the repeats

  void Describe(Fields& fields);
  std::string name() const;  // "experiment: variant.scene.method.s1"
};

// Of the records of the same run, one for each repeat, at least one. Records without a calibration
// have no speed.
GatedRun MakeGatedRun(const std::string& experiment, std::span<const RunRecord> repeats);

}  // namespace vitruvia
