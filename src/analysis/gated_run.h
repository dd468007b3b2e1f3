// The numbers of one run, over its repeats, that the regression gate compares with its baseline.
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "config/stored_data.h"
#include "records/run_record.h"

namespace vitruvia {

// Total times, as opposed to times of a frame's steps: the name of the time in GatedRun, and the
// metric that it is read from. A run has one of them; the first is the main one.
inline constexpr const char* kWholeFrame = "frame";
struct WholeTime {
  const char* name;
  const char* metric;
};
inline constexpr std::array kWholeTimes = {WholeTime{kWholeFrame, "frame_ms_median"},
                                           WholeTime{"fit", "fit_ms"}};

// Its name does not contain the hash of its config, so that a changed default is reported as a
// change and not as a different run.
struct GatedRun {
  std::string experiment, variant, scene, method;
  int seed = 0;
  int repeats = 0;
  // Values of the metrics of Place::kGate in the first repeat, by key. `unsteady` names metrics
  // that differ between repeats.
  std::map<std::string, double> accuracy;
  std::vector<std::string> unsteady;
  // Median time per frame in each repeat, ms, by name of a total time (kWholeTimes) or a step.
  // Comparable only with times of the same session on the same machine.
  std::map<std::string, std::vector<double>> times_ms;
  // Hash of the resolved config, and its settings as JSON by dotted key; a file counts by its name,
  // not by its folder. Empty in files of older programs; only a baseline stores the settings.
  std::string config_hash{};
  std::map<std::string, std::string> settings{};

  void Describe(Fields& fields);
  std::string name() const;  // "experiment: variant.scene.method.s1"
};

// From the records of the same run, one for each repeat (at least one). A time that is missing in a
// repeat is left out.
GatedRun MakeGatedRun(const std::string& experiment, std::span<const RunRecord> repeats);

// "fit.pair_cutoff_m: 0.08 → 0.1" for each setting that differs, in the order of the keys; a single
// sentence if the settings of one run are not known.
std::vector<std::string> ChangedSettings(const GatedRun& was, const GatedRun& is);

// The run of that name; nullptr if there is none.
const GatedRun* FindRun(const std::vector<GatedRun>& runs, const std::string& name);

}  // namespace vitruvia
