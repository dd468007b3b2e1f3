// Run records: the stored result of each run, and the only input of reports.
//
// An experiment's folder:
//   experiment.json        ExperimentRecord: title, what the paper says, which runs belong to it
//   summary.json           ExperimentSummary: one row per run, variants compared, failed runs
//   <run id>/record.json   RunRecord
//   <run id>/estimate/     see estimate.h
//   <run id>/status, log   "done KEY", or "failed KEY" and the reason; the run's messages
//   report.html, table.csv, table.tex, table.md, figures/*.png, figures/*.svg
#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "config/stored_data.h"
#include "records/frame_summary.h"

namespace vitruvia {

// A published number for comparison with a measured one.
struct Expectation {
  std::string metric;                 // a key of the summary row
  double paper = kAbsent;             // published value
  double at_most = kAbsent;           // our target
  std::string source;                 // "paper A, figure 11"
  std::string remark;                 // differences to the published experiment
  std::string not_comparable{};       // reason why the numbers are not comparable; "": they are
  double at_least = kAbsent;          // our target if higher is better
  std::vector<std::string> scenes{};  // the scenes that it applies to; empty: all

  bool IsAbout(const std::string& scene) const;
  void Describe(Fields& fields);
};

struct RunRecord {
  static constexpr StoredFormat kFormat{"vitruvia-record", 1, 0, "run the experiment again"};

  std::string run_id, experiment, variant, scene, method;
  int seed = 0;
  std::filesystem::path sequence_folder;  // relative to the experiment's folder
  std::string sequence_hash;
  nlohmann::json config;      // resolved: { "scene": …, "method": … }
  nlohmann::json provenance;  // commit, compiler, flags, CPU, threads (core/build_info.h)
  nlohmann::json summary;     // summary row: flat, metric → number or text
  // Per frame, all of one length; NaN where a frame has no such value. At least: frame_ms,
  // iterations, failed (0 or 1); where the sequence has true joints joint_error_mean_m; where it
  // has a true surface l2_mean_m, l2_max_m, l2_mean_visible_m, l2_mean_hidden_m.
  std::map<std::string, std::vector<double>> frames;
  // Share of (frame, joint) pairs with an error of at most threshold_m[i], for the classes all,
  // visible, hidden, and less_offset (all pairs, after subtracting each joint's mean offset).
  // Classes without pairs are left out.
  std::vector<double> threshold_m;
  std::map<std::string, std::vector<double>> joint_accuracy;
  std::map<std::string, double> joint_error_mean_m;  // per joint name
  // Per joint name, root mean squares over the frames in which the joint is visible: the
  // single-frame Cramér–Rao bound, and the error. Empty if the bound was not computed.
  std::map<std::string, double> joint_bound_m, joint_error_rms_m;
  struct Step {
    std::string name;
    double median_ms = 0, p95_ms = 0, max_ms = 0;

    void Describe(Fields& fields);
  };
  std::vector<Step> steps;            // per frame, in the method's order
  double diagonal_m = kAbsent;        // of the true subject's rest-pose bounding box
  std::vector<std::string> warnings;  // of the sequence's generation and its verification

  void Describe(Fields& fields);
  std::string Problem() const;
  static void Upgrade(Json& file, int version);
};

// How the values of a swept setting are spread, and its axis in plots.
enum class SweepScale { kLinear, kLogarithmic };

struct SweptSetting {
  std::string path;  // "method.settings.fit.edge_px", in the runs' config
  SweepScale scale = SweepScale::kLinear;
  nlohmann::json default_value;  // its value without the sweep

  void Describe(Fields& fields);
};

struct ExperimentRecord {
  static constexpr StoredFormat kFormat{"vitruvia-experiment", 1, 0, "run the experiment again"};

  std::string name;  // the config's path below configs/, e.g. "realtime_scape/fig11"
  std::string title, description;
  std::vector<Expectation> expectations;
  std::vector<int> picture_frames;  // of the report's picture strips; none: spread over the run
  bool side_by_side = false;        // whether the report shows runs below each other
  std::vector<std::string> table_columns{};  // metrics of the variants' table; none: the usual ones
  std::vector<FrameSummary> summaries{};     // defined by the experiment
  std::vector<SweptSetting> sweep{};         // the settings that the variants' names list after a
                                             // comma
  std::vector<std::string> run_ids;  // in the order of the grid; a missing run is reported as such
  std::map<std::string, std::string> failed_runs;  // run id → reason

  void Describe(Fields& fields);
};

// Summary of an experiment's numbers, for users and other programs.
struct ExperimentSummary {
  static constexpr StoredFormat kFormat{"vitruvia-summary", 1, 0, "run the experiment again"};

  std::string experiment;
  nlohmann::json variants = nlohmann::json::object();  // means of each variant and their comparison
  std::map<std::string, std::string> failed_runs;      // run id → reason
  std::vector<std::string> missing_runs;
  nlohmann::json rows = nlohmann::json::array();  // RunRecord::summary of each finished run

  void Describe(Fields& fields);
};

// DataError naming the file if it is missing, damaged or lacks a key.
ExperimentRecord ReadExperimentRecord(const std::filesystem::path& experiment_folder);
RunRecord ReadRunRecord(const std::filesystem::path& experiment_folder, const std::string& run_id);
void WriteExperimentRecord(const std::filesystem::path& experiment_folder,
                           const ExperimentRecord& record);
// std::invalid_argument naming the key if a number cannot be stored, or if the metric catalogue
// lacks the key of the summary row or of a series per frame.
void WriteRunRecord(const std::filesystem::path& experiment_folder, const RunRecord& record);
// "" if the catalogue has every key of the summary row and of the series per frame, otherwise a
// message that names the unknown key.
std::string UnknownMetricsProblem(const RunRecord& run);
ExperimentSummary ReadSummary(const std::filesystem::path& experiment_folder);
void WriteExperimentSummary(const std::filesystem::path& experiment_folder,
                            const ExperimentSummary& summary);

}  // namespace vitruvia
