// What the regression gate holds against its baseline: the numbers of one run over its repeats.
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "config/stored_data.h"
#include "records/run_record.h"

namespace vitruvia {

// What is timed as a whole, beside the steps of a frame: the name that a GatedRun keeps its speed
// under, and the metric that it is taken from. A run has one of them; the first is the main one.
inline constexpr const char* kWholeFrame = "frame";
struct WholeTime {
  const char* name;
  const char* metric;
};
inline constexpr std::array kWholeTimes = {WholeTime{kWholeFrame, "frame_ms_median"},
                                           WholeTime{"fit", "fit_ms"}};

// Named without the hash of its config, since a changed default must be seen as a change, not as
// another run.
struct GatedRun {
  std::string experiment, variant, scene, method;
  int seed = 0;
  int repeats = 0;
  // By key of the metrics of Place::kGate, of the first repeat: the same in all repeats, or
  // `unsteady` names those that are not.
  std::map<std::string, double> accuracy;
  std::vector<std::string> unsteady;
  // By name of what was timed (kWholeTimes or a step): its median time per frame in each repeat,
  // ms. Compares with times of the same sitting on the same machine only.
  std::map<std::string, std::vector<double>> times_ms;
  // Of the resolved config: a hash, and by dotted key each setting as JSON. "" and none in files of
  // older programs; only a baseline stores the settings themselves.
  std::string config_hash{};
  std::map<std::string, std::string> settings{};

  void Describe(Fields& fields);
  std::string name() const;  // "experiment: variant.scene.method.s1"
};

// Of the records of the same run, one for each repeat, at least one. What was not timed in every
// repeat has no times.
GatedRun MakeGatedRun(const std::string& experiment, std::span<const RunRecord> repeats);

// "fit.pair_cutoff_m: 0.08 → 0.1" of each setting that differs, in the order of the keys; one
// sentence where a side does not know its settings.
std::vector<std::string> ChangedSettings(const GatedRun& was, const GatedRun& is);

// The run of that name; nullptr if there is none.
const GatedRun* FindRun(const std::vector<GatedRun>& runs, const std::string& name);

}  // namespace vitruvia
