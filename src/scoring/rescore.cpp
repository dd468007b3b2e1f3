#include "scoring/rescore.h"

#include "config/json_settings.h"
#include "core/build_info.h"
#include "core/error.h"
#include "scoring/score.h"
#include "scoring/summaries.h"

namespace vitruvia {
namespace fs = std::filesystem;

namespace {

// As the run was scored; older records say nothing and measured only the usual.
ScoreSettings ScoreSettingsOf(const RunRecord& record) {
  const Json settings = record.config.value("score", Json::object());
  return ReadSettings<ScoreSettings>(settings, {record.run_id, "config.score"});
}

}  // namespace

RunRecord Rescored(const fs::path& experiment_folder, const RunRecord& record,
                   const std::vector<FrameSummary>& summaries) {
  const SequenceReader sequence(experiment_folder / record.sequence_folder);
  if (sequence.hash() != record.sequence_hash) {
    throw DataError(fmt::format(
        "{}: {} is another sequence than the one that was tracked: expected hash {}, got {}",
        record.run_id, sequence.folder().string(), record.sequence_hash, sequence.hash()));
  }
  RunRecord fresh;
  fresh.run_id = record.run_id;
  fresh.experiment = record.experiment;
  fresh.variant = record.variant;
  fresh.scene = record.scene;
  fresh.method = record.method;
  fresh.seed = record.seed;
  fresh.sequence_folder = record.sequence_folder;
  fresh.sequence_hash = record.sequence_hash;
  fresh.config = record.config;
  fresh.provenance = record.provenance;
  fresh.warnings = record.warnings;
  fresh.provenance["rescored_by"] = Provenance();
  fresh.summary = nlohmann::json::object();
  for (const char* key : {"run_id", "variant", "scene", "seed", "method", "repeat"}) {
    if (record.summary.contains(key)) fresh.summary[key] = record.summary.at(key);
  }
  const EstimateReader estimate(experiment_folder / record.run_id / "estimate");
  ScoreRun(sequence, estimate, ScoreSettingsOf(record), fresh);
  AddSummaries(sequence, estimate, summaries, fresh);
  return fresh;
}

}  // namespace vitruvia
