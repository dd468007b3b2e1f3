#include "records/run_record.h"

#include <algorithm>

#include "core/error.h"
#include "core/files.h"
#include "metrics/catalogue.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kExperimentFile = "experiment.json";
constexpr const char* kRunFile = "record.json";
constexpr const char* kSummaryFile = "summary.json";

// "" or which list of a map differs in length from `length` items.
std::string LengthProblem(const std::map<std::string, std::vector<double>>& lists,
                          std::size_t length, const char* key) {
  for (const auto& [name, values] : lists) {
    if (values.size() == length) continue;
    return fmt::format("{}.{}: expected {} values, got {}", key, name, length, values.size());
  }
  return "";
}

// Values that are better higher or lower, and those that the program counts with. As text they
// would pass for absent.
bool MustBeNumber(const std::string& key) {
  if (key == "frames" || key == "repeat" || key == "seed") return true;
  return UnknownMetricProblem(key).empty() && FindMetric(key).better != Better::kNeither;
}

std::string RowProblem(const nlohmann::json& row) {
  if (!row.is_object()) return "summary: expected an object, got " + row.dump();
  for (const auto& [key, value] : row.items()) {
    if (value.is_structured())
      return fmt::format("summary.{}: expected a number, a text, true or false, got {}", key,
                         value.dump());
    if (!value.is_number() && !value.is_boolean() && MustBeNumber(key))
      return fmt::format("summary.{}: expected a number, got {}", key, value.dump());
  }
  return "";
}

// Of the keys that reports and plans read.
std::string ProvenanceProblem(const nlohmann::json& provenance) {
  const nlohmann::json::json_pointer threads("/threads"), commit("/commit"), wall_s("/run/wall_s");
  for (const auto& number : {threads, wall_s}) {
    if (provenance.contains(number) && !provenance.at(number).is_number())
      return fmt::format("provenance{}: expected a number, got {}", number.to_string(),
                         provenance.at(number).dump());
  }
  if (provenance.contains(commit) && !provenance.at(commit).is_string())
    return "provenance/commit: expected a text, got " + provenance.at(commit).dump();
  return "";
}

}  // namespace

bool Expectation::IsAbout(const std::string& scene) const {
  return scenes.empty() || std::find(scenes.begin(), scenes.end(), scene) != scenes.end();
}

void Expectation::Describe(Fields& f) {
  f.Text("metric", metric, {.meaning = "key of the summary row"});
  f.Number("paper", paper,
           {.meaning = "value that the paper prints, in the metric's unit", .optional = true});
  f.Number("at_most", at_most,
           {.meaning = "upper bound that this work sets itself", .optional = true});
  f.Number("at_least", at_least,
           {.meaning = "lower bound that this work sets itself", .optional = true});
  f.Text("source", source, {.meaning = "where the published value stands"});
  f.Text("remark", remark, {.meaning = "how this work differs from the paper's"});
  f.Text("not_comparable", not_comparable,
         {.meaning = "why this work's value says nothing about the paper's; absent if it does",
          .optional = true});
  f.Texts("scenes", scenes,
          {.meaning = "scenes that the expectation is about; absent: all", .optional = true});
}

void RunRecord::Step::Describe(Fields& f) {
  f.Text("name", name, {.meaning = "name of the step"});
  f.Number("median_ms", median_ms, {.meaning = "median time in a frame", .unit = "ms"});
  f.Number("p95_ms", p95_ms, {.meaning = "95th percentile of the time in a frame", .unit = "ms"});
  f.Number("max_ms", max_ms, {.meaning = "longest time in a frame", .unit = "ms"});
}

void RunRecord::Describe(Fields& f) {
  f.Text("run_id", run_id, {.meaning = "identity of the run, the name of its folder"});
  f.Text("experiment", experiment, {.meaning = "name of the experiment"});
  f.Text("variant", variant, {.meaning = "name of the variant"});
  f.Text("scene", scene, {.meaning = "name of the scene"});
  f.Text("method", method, {.meaning = "name of the method"});
  f.Integer("seed", seed, {.meaning = "seed of all random streams of the run"});
  std::string folder = sequence_folder.generic_string();
  f.Text("sequence_folder", folder,
         {.meaning = "folder of the sequence relative to the experiment's folder; empty if the run "
                     "has no sequence"});
  sequence_folder = folder;
  f.Text("sequence_hash", sequence_hash,
         {.meaning = "hash of the sequence's content; empty if the run has no sequence"});
  f.FreeJson("config", config, {.meaning = "resolved settings of the run"});
  f.FreeJson("provenance", provenance,
             {.meaning = "commit, compiler, flags, CPU and calibration time of the run"});
  f.FreeJson("summary", summary,
             {.meaning = "the run's row: metric → number, text, true or false", .infinite = true});
  f.Map("frames", frames,
        {.meaning = "series: name → one value for each frame, null where a frame has none",
         .null_items = true,
         .infinite = true});
  f.NumberList("threshold_m", threshold_m,
               {.meaning = "thresholds of the joint accuracy curves; absent where no joints were "
                           "scored",
                .unit = "m",
                .optional = true});
  f.Map("joint_accuracy", joint_accuracy,
        {.meaning = "class of joints (all, visible, hidden; less_offset: all, after the mean "
                    "offset of each joint is taken off) → share of joints with an error of at most "
                    "each threshold; absent where no joints were scored",
         .optional = true});
  f.Map("joint_error_mean_m", joint_error_mean_m,
        {.meaning = "joint → mean error; absent where no joints were scored",
         .unit = "m",
         .optional = true});
  f.Map("joint_bound_m", joint_bound_m,
        {.meaning = "joint → smallest error that a single frame allows (Cramér–Rao), root mean "
                    "square over the frames in which it is visible; absent where it was not "
                    "computed",
         .unit = "m",
         .optional = true});
  f.Map("joint_error_rms_m", joint_error_rms_m,
        {.meaning = "joint → error over the same frames, root mean square",
         .unit = "m",
         .optional = true});
  f.List("steps", steps, {.meaning = "times of the method's steps, in its order"});
  f.Number("diagonal_m", diagonal_m,
           {.meaning = "diagonal of the bounding box of the true subject in the rest pose; absent "
                       "without a true surface",
            .unit = "m",
            .optional = true});
  f.Texts("warnings", warnings,
          {.meaning = "what was told of the sequence and the subject before the first frame: by "
                      "the program that made the sequence, and by its verification",
           .optional = true});
}

// Version 0 wrote a diagonal of 0 where there was no true surface.
void RunRecord::Upgrade(Json& file, int /*version*/) {
  if (file.is_object() && file.contains("diagonal_m") && file.at("diagonal_m") == 0.0)
    file.erase("diagonal_m");
}

std::string RunRecord::Problem() const {
  const std::size_t frame_count = frames.empty() ? 0 : frames.begin()->second.size();
  for (const std::string& problem :
       {RowProblem(summary), ProvenanceProblem(provenance),
        LengthProblem(frames, frame_count, "frames"),
        LengthProblem(joint_accuracy, threshold_m.size(), "joint_accuracy")}) {
    if (!problem.empty()) return problem;
  }
  return "";
}

void SweptSetting::Describe(Fields& f) {
  f.Text("setting", path, {.meaning = "path of the setting in the config of each run"});
  f.Choice("scale", scale, {{"linear", SweepScale::kLinear}, {"log", SweepScale::kLogarithmic}},
           {.meaning = "whether differences or ratios of its values count"});
  f.FreeJson("default", default_value, {.meaning = "value without the sweep"});
}

void ExperimentRecord::Describe(Fields& f) {
  f.Text("name", name, {.meaning = "path of the experiment's file below configs/"});
  f.Text("title", title, {.meaning = "title of the report"});
  f.Text("description", description, {.meaning = "what the experiment shows"});
  f.List("expectations", expectations, {.meaning = "published values and targets"});
  f.Integers("picture_frames", picture_frames, {.meaning = "frames of the report's pictures"});
  f.Flag("side_by_side", side_by_side,
         {.meaning = "whether the report shows the pictures of all runs below each other"});
  f.Texts(
      "table_columns", table_columns,
      {.meaning = "metrics of the table of variants; absent: the usual ones", .optional = true});
  f.List("summaries", summaries,
         {.meaning = "summaries that the experiment defines", .optional = true});
  f.List("sweep", sweep, {.meaning = "settings that the variants sweep", .optional = true});
  f.Texts("run_ids", run_ids, {.meaning = "runs of the experiment, in the order of its grid"});
  f.Map("failed_runs", failed_runs, {.meaning = "run → why it failed or is out of date"});
}

void ExperimentSummary::Describe(Fields& f) {
  f.Text("experiment", experiment, {.meaning = "name of the experiment"});
  f.FreeJson("variants", variants,
             {.meaning = "means of each variant over its runs, and differences from the first "
                         "variant",
              .infinite = true});
  f.Map("failed_runs", failed_runs, {.meaning = "run → why it failed"});
  f.Texts("missing_runs", missing_runs,
          {.meaning = "runs that are not carried out or out of date"});
  f.FreeJson(
      "rows", rows,
      {.meaning = "the row of each finished run (summary of record.json)", .infinite = true});
}

ExperimentRecord ReadExperimentRecord(const fs::path& experiment_folder) {
  return ReadStored<ExperimentRecord>(experiment_folder / kExperimentFile);
}

RunRecord ReadRunRecord(const fs::path& experiment_folder, const std::string& run_id) {
  const fs::path file = experiment_folder / run_id / kRunFile;
  RunRecord record = ReadStored<RunRecord>(file);
  if (record.run_id != run_id) {
    throw DataError(fmt::format("{}: run_id: expected the folder's name \"{}\", got \"{}\"",
                                file.string(), run_id, record.run_id));
  }
  return record;
}

void WriteExperimentRecord(const fs::path& experiment_folder, const ExperimentRecord& record) {
  RequireStorable(record, "");  // before the folder is made
  MakeFolder(experiment_folder);
  WriteStored(experiment_folder / kExperimentFile, record);
}

void WriteRunRecord(const fs::path& experiment_folder, const RunRecord& record) {
  if (const std::string problem = UnknownMetricsProblem(record); !problem.empty()) {
    throw std::invalid_argument(problem);
  }
  RequireStorable(record, "");
  MakeFolder(experiment_folder / record.run_id);
  WriteStored(experiment_folder / record.run_id / kRunFile, record);
}

std::string UnknownMetricsProblem(const RunRecord& run) {
  for (const auto& item : run.summary.items()) {
    const std::string problem = UnknownMetricProblem(item.key());
    if (!problem.empty()) return "summary: " + problem;
  }
  for (const auto& [name, values] : run.frames) {
    const std::string problem = UnknownMetricProblem(name);
    if (!problem.empty()) return "frames: " + problem;
  }
  return "";
}

ExperimentSummary ReadSummary(const fs::path& experiment_folder) {
  return ReadStored<ExperimentSummary>(experiment_folder / kSummaryFile);
}

void WriteExperimentSummary(const fs::path& experiment_folder, const ExperimentSummary& summary) {
  constexpr int kIndent = 2;
  WriteStored(experiment_folder / kSummaryFile, summary, kIndent);
}

}  // namespace vitruvia
