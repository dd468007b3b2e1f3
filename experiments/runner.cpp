#include "experiments/runner.h"

#include "core/build_info.h"
#include "core/error.h"
#include "core/files.h"
#include "core/progress.h"
#include "core/timer.h"
#include "experiments/kept_work.h"
#include "experiments/score.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

// Reads a small marker file; "" where there is none.
std::string MarkerOf(const fs::path& file) {
  return fs::is_regular_file(file) ? ReadWholeFile(file) : "";
}

RunRecord CarryOut(const RunPlan& run, const std::string& experiment, const fs::path& folder,
                   const WorkFolders& work) {
  const fs::path sequence_folder = ObtainSequence(run.scene, run.scene_settings, work.sequences);
  const SequenceReader sequence(sequence_folder);
  const BodyModel subject =
      run.subject ? ObtainFittedSubject(*run.subject, run.scene_settings, work.learned)
                  : sequence.subject();
  TrackSequence(sequence, run.method, subject, folder / run.run_id / "estimate");

  RunRecord record;
  record.run_id = run.run_id;
  record.experiment = experiment;
  record.variant = run.variant;
  record.scene = run.scene;
  record.method = run.method_name;
  record.seed = run.seed;
  record.config = run.resolved;
  record.provenance = TimedProvenance();
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

void WriteSummary(const ExperimentRecord& experiment, const fs::path& folder) {
  Json rows = Json::array();
  for (const std::string& run_id : experiment.run_ids) {
    if (experiment.failed_runs.contains(run_id)) continue;
    rows.push_back(ReadRunRecord(folder, run_id).summary);
  }
  const Json failed = experiment.failed_runs;
  WriteWholeFile(
      folder / "summary.json",
      Json{{"experiment", experiment.name}, {"rows", rows}, {"failed_runs", failed}}.dump(2) +
          "\n");
}

}  // namespace

void TrackSequence(const SequenceReader& sequence, const MethodConfig& method,
                   const BodyModel& subject, const fs::path& folder) {
  const SequenceInfo& info = sequence.info();
  const std::unique_ptr<Tracker> tracker = MakeTracker(method);
  EstimateWriter writer(folder, subject.rest);
  Progress progress("track " + method.method, info.frames);
  tracker->Start(subject, info.camera);
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
  const KeptFolder kept(sequences, name, WriteSettings(scene));
  if (kept.complete()) return kept.path();
  SynthesizeSequence(scene, kept.path());
  kept.MarkComplete();
  return kept.path();
}

std::vector<PlannedRun> TrackingRuns(const ExperimentPlan& plan, const fs::path& folder,
                                     const WorkFolders& work) {
  std::vector<PlannedRun> runs;
  for (const RunPlan& run : plan.runs) {
    runs.push_back({run.run_id, WorkKey(run.resolved),
                    [&run, name = plan.record.name, folder, work](const fs::path& run_folder) {
                      RunRecord record = CarryOut(run, name, folder, work);
                      WriteWholeFile(run_folder / "log", LogOf(run_folder / "estimate"));
                      return record;
                    }});
  }
  return runs;
}

ExperimentOutcome CarryOutRuns(const ExperimentRecord& planned, const std::vector<PlannedRun>& runs,
                               const fs::path& folder) {
  ExperimentOutcome outcome;
  ExperimentRecord experiment = planned;
  MakeFolder(folder);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const PlannedRun& run = runs[i];
    const fs::path run_folder = folder / run.run_id;
    const std::string done = "done " + run.key + "\n";
    if (MarkerOf(run_folder / "status") == done) {
      ++outcome.kept;
      continue;
    }
    MakeFolder(run_folder);
    fs::remove(run_folder / "status");
    fmt::print(stderr, "run {}/{}: {}\n", i + 1, runs.size(), run.run_id);
    try {
      WriteRunRecord(folder, run.carry_out(run_folder));
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
  WriteSummary(experiment, folder);
  return outcome;
}

}  // namespace vitruvia
