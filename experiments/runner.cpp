#include "experiments/runner.h"

#include "core/build_info.h"
#include "core/error.h"
#include "core/files.h"
#include "core/hash.h"
#include "core/progress.h"
#include "core/timer.h"
#include "experiments/score.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

// What a stored result depends on. Two equal keys mean that running again would change nothing but
// the clock.
std::string ResultKey(const Json& resolved, const SceneSettings& scene) {
  Hash64 hash;
  hash.Add(GetBuildInfo().build_id).Add(resolved.dump());
  for (const fs::path& file : {scene.motion.file, scene.motion.skeleton}) {
    if (fs::is_regular_file(file)) hash.AddFile(file);
  }
  return hash.Hex();
}

// Reads a small marker file; "" where there is none.
std::string MarkerOf(const fs::path& file) {
  return fs::is_regular_file(file) ? ReadWholeFile(file) : "";
}

RunRecord CarryOut(const RunPlan& run, const ExperimentPlan& plan, const fs::path& folder,
                   const fs::path& sequences) {
  const fs::path sequence_folder = ObtainSequence(run.scene, run.scene_settings, sequences);
  const SequenceReader sequence(sequence_folder);
  TrackSequence(sequence, run.method, folder / run.run_id / "estimate");

  RunRecord record;
  record.run_id = run.run_id;
  record.experiment = plan.record.name;
  record.variant = run.variant;
  record.scene = run.scene;
  record.method = run.method_name;
  record.seed = run.seed;
  record.config = run.resolved;
  record.provenance = Provenance();
  record.sequence_folder = fs::absolute(sequence_folder).lexically_relative(fs::absolute(folder));
  record.sequence_hash = sequence.hash();
  record.summary = {{"run_id", run.run_id},
                    {"variant", run.variant},
                    {"scene", run.scene},
                    {"seed", run.seed},
                    {"method", run.method_name}};
  ScoreRun(sequence, EstimateReader(folder / run.run_id / "estimate"), record);
  return record;
}

std::string LogOf(const fs::path& estimate_folder) {
  std::string log;
  const EstimateReader estimate(estimate_folder);
  for (std::size_t i = 0; i < estimate.frames().size(); ++i) {
    const FrameEstimate& frame = estimate.frames()[i];
    if (frame.message.empty()) continue;
    log += fmt::format("frame {}: {}: {}\n", i, Name(frame.outcome), frame.message);
  }
  return log;
}

void WriteSummary(const ExperimentPlan& plan, const ExperimentRecord& experiment,
                  const fs::path& folder) {
  Json rows = Json::array();
  for (const RunPlan& run : plan.runs) {
    if (experiment.failed_runs.contains(run.run_id)) continue;
    rows.push_back(ReadRunRecord(folder, run.run_id).summary);
  }
  const Json failed = experiment.failed_runs;
  WriteWholeFile(
      folder / "summary.json",
      Json{{"experiment", experiment.name}, {"rows", rows}, {"failed_runs", failed}}.dump(2) +
          "\n");
}

}  // namespace

void TrackSequence(const SequenceReader& sequence, const MethodConfig& method,
                   const fs::path& folder) {
  const SequenceInfo& info = sequence.info();
  const std::unique_ptr<Tracker> tracker = MakeTracker(method);
  EstimateWriter writer(folder, sequence.subject().rest);
  Progress progress("track " + method.method, info.frames);
  tracker->Start(sequence.subject(), info.camera);
  for (int i = 0; i < info.frames; ++i) {
    const DepthFrame frame{i, i / info.fps, sequence.ReadDepth(i)};
    const Stopwatch watch;
    const TrackResult result = tracker->TrackFrame(frame);
    writer.Append(result, watch.ElapsedMs());
    progress.Advance();
  }
  writer.Finish();
}

fs::path ObtainSequence(const std::string& name, const SceneSettings& scene,
                        const fs::path& sequences) {
  const Json resolved = WriteSettings(scene);
  const fs::path folder =
      sequences / fmt::format("{}-{}", name, Hash64().Add(resolved.dump()).Hex());
  const fs::path marker = folder.string() + ".key";
  const std::string key = ResultKey(resolved, scene);
  if (fs::is_directory(folder) && MarkerOf(marker) == key) return folder;
  MakeFolder(sequences);
  SynthesizeSequence(scene, folder);
  WriteWholeFile(marker, key);
  return folder;
}

ExperimentOutcome RunExperiment(const ExperimentPlan& plan, const fs::path& folder,
                                const fs::path& sequences) {
  ExperimentOutcome outcome;
  ExperimentRecord experiment = plan.record;
  MakeFolder(folder);
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    const RunPlan& run = plan.runs[i];
    const fs::path run_folder = folder / run.run_id;
    const std::string done = "done " + ResultKey(run.resolved, run.scene_settings) + "\n";
    if (MarkerOf(run_folder / "status") == done) {
      ++outcome.kept;
      continue;
    }
    MakeFolder(run_folder);
    fs::remove(run_folder / "status");
    fmt::print(stderr, "run {}/{}: {}\n", i + 1, plan.runs.size(), run.run_id);
    try {
      WriteRunRecord(folder, CarryOut(run, plan, folder, sequences));
      WriteWholeFile(run_folder / "log", LogOf(run_folder / "estimate"));
      WriteWholeFile(run_folder / "status", done);
      ++outcome.done;
    } catch (const std::exception& error) {
      ThrowIfInterrupted();
      experiment.failed_runs[run.run_id] = error.what();
      WriteWholeFile(run_folder / "status", fmt::format("failed: {}\n", error.what()));
      fmt::print(stderr, "run failed: {}\n", error.what());
      ++outcome.failed;
    }
  }
  WriteExperimentRecord(folder, experiment);
  WriteSummary(plan, experiment, folder);
  return outcome;
}

}  // namespace vitruvia
