#include "experiments/run/tracking_runs.h"

#include <algorithm>

#include "config/build_cache.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/files.h"
#include "core/process_memory.h"
#include "core/progress.h"
#include "core/timer.h"
#include "scoring/score.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

// The sequence of a scene, made unless the very same one is there already (same settings, same
// input files, same build).
CachedFolder SequenceOf(const RunPlan& run, const WorkFolders& work) {
  return {work.sequences, run.scene, WriteSettings(run.scene_settings)};
}

fs::path ObtainSequence(const RunPlan& run, const WorkFolders& work) {
  if (!run.sequence.empty()) return run.sequence;
  const CachedFolder kept = SequenceOf(run, work);
  kept.GetOrBuild([&run](const fs::path& made) { SynthesizeSequence(run.scene_settings, made); });
  return kept.path();
}

BodyModel ObtainSubject(const RunPlan& run, const SequenceReader& sequence,
                        const WorkFolders& work) {
  if (run.subject) return ObtainFittedSubject(*run.subject, run.scene_settings, work.learned);
  if (!run.subject_folder.empty()) return ReadBodyModel(run.subject_folder);
  return sequence.subject();
}

RunRecord CarryOut(const RunPlan& run, const std::string& experiment, const fs::path& folder,
                   const WorkFolders& work) {
  const SequenceReader sequence(ObtainSequence(run, work));
  BodyModel subject = ObtainSubject(run, sequence, work);
  DamageSubject(run.faults.subject, subject);
  const auto damage = [&](DepthFrame& frame) {
    DamageFrame(run.faults.depth, sequence.info().depth_unit_m, run.seed, frame);
  };
  TrackSequence(sequence, run.method, subject, damage, folder / run.run_id / "estimate");

  RunRecord record;
  record.run_id = run.run_id;
  record.experiment = experiment;
  record.variant = run.variant;
  record.scene = run.scene;
  record.method = run.method_name;
  record.seed = run.seed;
  record.config = WithPortablePaths(run.resolved);
  record.provenance = TimedProvenance();
  record.sequence_folder = fs::absolute(sequence.folder()).lexically_relative(fs::absolute(folder));
  record.sequence_hash = sequence.hash();
  record.summary = {{"run_id", run.run_id},
                    {"variant", run.variant},
                    {"scene", run.scene},
                    {"seed", run.seed},
                    {"method", run.method_name}};
  if (run.repeat > 0) record.summary["repeat"] = run.repeat;
  ScoreRun(sequence, EstimateReader(folder / run.run_id / "estimate"), run.score, record);
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

}  // namespace

void TrackSequence(const SequenceReader& sequence, const MethodConfig& method,
                   const BodyModel& subject, const std::function<void(DepthFrame&)>& prepare,
                   const fs::path& folder) {
  const SequenceInfo& info = sequence.info();
  ForgetPeakMemory();
  const double before_mb = ResidentMemory_mb();
  const std::unique_ptr<Tracker> tracker = MakeTracker(method);
  EstimateWriter writer(folder, subject.rest);
  Progress progress("track " + method.method, info.frames);
  tracker->Start(subject, info.camera);
  for (int i = 0; i < info.frames; ++i) {
    DepthFrame frame{i, i / info.fps, sequence.ReadDepth(i)};
    prepare(frame);
    const Stopwatch watch;
    const TrackResult result = tracker->TrackFrame(frame);
    writer.Append(result, watch.ElapsedMs());
    progress.Advance();
  }
  writer.Finish(std::max(0.0, PeakMemory_mb() - before_mb));
}

std::vector<PlannedRun> TrackingRuns(const ExperimentPlan& plan, const fs::path& folder,
                                     const WorkFolders& work) {
  std::vector<PlannedRun> runs;
  for (const RunPlan& run : plan.runs) {
    PlannedRun planned;
    planned.run_id = run.run_id;
    planned.key = CacheKey(run.resolved);
    planned.carry_out = [&run, name = plan.record.name, folder, work](const fs::path& run_folder) {
      RunRecord record = CarryOut(run, name, folder, work);
      WriteWholeFile(run_folder / "log", LogOf(run_folder / "estimate"));
      return record;
    };
    planned.variant = run.variant;
    planned.scene = run.scene;
    planned.method = run.method_name;
    planned.frames = run.frames;
    planned.timed = plan.timed;
    if (run.sequence.empty()) planned.shares = SequenceOf(run, work);
    runs.push_back(std::move(planned));
  }
  return runs;
}

}  // namespace vitruvia
