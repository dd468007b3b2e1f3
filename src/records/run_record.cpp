#include "records/run_record.h"

#include <algorithm>

#include "config/json_node.h"
#include "core/files.h"

namespace vitruvia {
namespace fs = std::filesystem;
using Json = nlohmann::json;
namespace {

constexpr const char* kExperimentFile = "experiment.json";
constexpr const char* kRunFile = "record.json";
constexpr int kIndent = 1;

// Free parts of a record are written by others: a NaN in them would become null without a word.
const Json& Checked(const Json& json, const std::string& path) {
  if (json.is_number_float()) Finite(json.get<double>(), path);
  if (json.is_structured()) {
    for (const auto& item : json.items()) Checked(item.value(), path + "." + item.key());
  }
  return json;
}

// "No value in this frame" (no hidden joint, say) is NaN in memory and null in the file.
Json SeriesToJson(const std::map<std::string, std::vector<double>>& series,
                  const std::string& path) {
  Json json = Json::object();
  for (const auto& [name, values] : series) {
    Json list = Json::array();
    for (const double value : values) list.push_back(FiniteOrNull(value, path + "." + name));
    json[name] = std::move(list);
  }
  return json;
}

Json StepsToJson(const std::vector<RunRecord::Step>& steps) {
  Json json = Json::array();
  for (const RunRecord::Step& step : steps) {
    json.push_back({{"name", step.name},
                    {"median_ms", Finite(step.median_ms, step.name + ".median_ms")},
                    {"p95_ms", Finite(step.p95_ms, step.name + ".p95_ms")},
                    {"max_ms", Finite(step.max_ms, step.name + ".max_ms")}});
  }
  return json;
}

RunRecord::Step ParseStep(const JsonNode& node) {
  return {node.At("name").Text(), node.At("median_ms").Number(), node.At("p95_ms").Number(),
          node.At("max_ms").Number()};
}

// A map of lists that must all be as long as `length`, or as the first if that is negative.
std::map<std::string, std::vector<double>> ParseSeries(const JsonNode& node, int length) {
  auto series = node.Map([](const JsonNode& item) { return item.NumbersOrNull(); });
  for (const auto& [name, values] : series) {
    if (length < 0) length = static_cast<int>(values.size());
    if (static_cast<int>(values.size()) != length) {
      node.At(name).Fail(fmt::format("expected {} values, found {}", length, values.size()));
    }
  }
  return series;
}

Expectation ParseExpectation(const JsonNode& node) {
  return {node.At("metric").Text(),
          node.At("paper").NumberOr(kNoValue),
          node.At("at_most").NumberOr(kNoValue),
          node.At("source").Text(),
          node.At("remark").Text(),
          node.json().contains("not_comparable") ? node.At("not_comparable").Text() : "",
          node.At("at_least").NumberOr(kNoValue),
          node.At("scenes").List([](const JsonNode& scene) { return scene.Text(); })};
}

RunRecord ParseRunRecord(const JsonNode& node) {
  RunRecord r;
  r.run_id = node.At("run_id").Text();
  r.experiment = node.At("experiment").Text();
  r.variant = node.At("variant").Text();
  r.scene = node.At("scene").Text();
  r.method = node.At("method").Text();
  r.seed = node.At("seed").Integer();
  r.sequence_folder = node.At("sequence_folder").Text();
  r.sequence_hash = node.At("sequence_hash").Text();
  r.config = node.At("config").json();
  r.provenance = node.At("provenance").json();
  r.summary = node.At("summary").json();
  if (!r.summary.is_object()) node.At("summary").Fail("expected an object");
  r.frames = ParseSeries(node.At("frames"), -1);
  r.threshold_m = node.At("threshold_m").Numbers();
  r.joint_accuracy = ParseSeries(node.At("joint_accuracy"), static_cast<int>(r.threshold_m.size()));
  r.joint_error_mean_m = node.At("joint_error_mean_m").Map([](const JsonNode& item) {
    return item.NumberOr(kNoValue);
  });
  r.steps = node.At("steps").List(ParseStep);
  r.diagonal_m = node.At("diagonal_m").Number();
  return r;
}

ExperimentRecord ParseExperimentRecord(const JsonNode& node) {
  ExperimentRecord e;
  e.name = node.At("name").Text();
  e.title = node.At("title").Text();
  e.description = node.At("description").Text();
  e.expectations = node.At("expectations").List(ParseExpectation);
  e.picture_frames =
      node.At("picture_frames").List([](const JsonNode& item) { return item.Integer(); });
  if (node.json().contains("side_by_side")) {  // older records have none
    e.side_by_side = node.At("side_by_side").Flag();
  }
  e.run_ids = node.At("run_ids").Texts();
  e.failed_runs = node.At("failed_runs").Map([](const JsonNode& item) { return item.Text(); });
  return e;
}

}  // namespace

bool Expectation::IsAbout(const std::string& scene) const {
  return scenes.empty() || std::find(scenes.begin(), scenes.end(), scene) != scenes.end();
}

void to_json(Json& json, const Expectation& e) {
  json = {{"metric", e.metric},
          {"paper", FiniteOrNull(e.paper, e.metric + ".paper")},
          {"at_most", FiniteOrNull(e.at_most, e.metric + ".at_most")},
          {"source", e.source},
          {"remark", e.remark},
          {"not_comparable", e.not_comparable},
          {"at_least", FiniteOrNull(e.at_least, e.metric + ".at_least")},
          {"scenes", e.scenes}};
}

void from_json(const Json& json, Expectation& e) {
  e = ParseExpectation(JsonNode(json, "expectation"));
}

void to_json(Json& json, const RunRecord& r) {
  Json joint_errors = Json::object();
  for (const auto& [joint, error_m] : r.joint_error_mean_m) {
    joint_errors[joint] = FiniteOrNull(error_m, "joint_error_mean_m." + joint);
  }
  json = {{"run_id", r.run_id},
          {"experiment", r.experiment},
          {"variant", r.variant},
          {"scene", r.scene},
          {"method", r.method},
          {"seed", r.seed},
          {"sequence_folder", r.sequence_folder.generic_string()},
          {"sequence_hash", r.sequence_hash},
          {"config", Checked(r.config, "config")},
          {"provenance", Checked(r.provenance, "provenance")},
          {"summary", Checked(r.summary, "summary")},
          {"frames", SeriesToJson(r.frames, "frames")},
          {"threshold_m", Checked(Json(r.threshold_m), "threshold_m")},
          {"joint_accuracy", SeriesToJson(r.joint_accuracy, "joint_accuracy")},
          {"joint_error_mean_m", joint_errors},
          {"steps", StepsToJson(r.steps)},
          {"diagonal_m", Finite(r.diagonal_m, "diagonal_m")}};
}

void from_json(const Json& json, RunRecord& r) { r = ParseRunRecord(JsonNode(json, "run record")); }

void to_json(Json& json, const ExperimentRecord& e) {
  json = {{"name", e.name},
          {"title", e.title},
          {"description", e.description},
          {"expectations", e.expectations},
          {"picture_frames", e.picture_frames},
          {"side_by_side", e.side_by_side},
          {"run_ids", e.run_ids},
          {"failed_runs", e.failed_runs}};
}

void from_json(const Json& json, ExperimentRecord& e) {
  e = ParseExperimentRecord(JsonNode(json, "experiment record"));
}

ExperimentRecord ReadExperimentRecord(const fs::path& experiment_folder) {
  const fs::path file = experiment_folder / kExperimentFile;
  return ParseExperimentRecord(JsonNode(ReadStoredJson(file), file.string()));
}

RunRecord ReadRunRecord(const fs::path& experiment_folder, const std::string& run_id) {
  const fs::path file = experiment_folder / run_id / kRunFile;
  const Json json = ReadStoredJson(file);
  const JsonNode node(json, file.string());
  RunRecord record = ParseRunRecord(node);
  if (record.run_id != run_id) {
    node.At("run_id").Fail(fmt::format("expected the folder's name \"{}\"", run_id));
  }
  return record;
}

void WriteExperimentRecord(const fs::path& experiment_folder, const ExperimentRecord& record) {
  const Json json = record;
  MakeFolder(experiment_folder);
  WriteWholeFile(experiment_folder / kExperimentFile, json.dump(kIndent) + "\n");
}

void WriteRunRecord(const fs::path& experiment_folder, const RunRecord& record) {
  const Json json = record;
  MakeFolder(experiment_folder / record.run_id);
  WriteWholeFile(experiment_folder / record.run_id / kRunFile, json.dump(kIndent) + "\n");
}

}  // namespace vitruvia
