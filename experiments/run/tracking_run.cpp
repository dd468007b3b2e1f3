#include "experiments/run/tracking_run.h"

#include <algorithm>

#include "body/skeleton.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/files.h"
#include "core/process_memory.h"
#include "core/progress.h"
#include "core/timer.h"
#include "experiments/plan/run_plan.h"
#include "geometry/mesh.h"
#include "scoring/score.h"
#include "scoring/summaries.h"
#include "tracking/astray.h"
#include "verification/verification.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

// DataError with the remedy if a sequence that was generated here was damaged since.
SequenceReader ObtainSequence(const RunPlan& run, const WorkFolders& work) {
  if (!run.sequence.empty()) return SequenceReader(run.sequence);
  const CachedFolder kept = SequenceOf(run, work.sequences);
  kept.GetOrBuild([&run](const fs::path& made) { SynthesizeSequence(run.scene_settings, made); });
  try {
    return SequenceReader(kept.path());
  } catch (const DataError& error) {
    throw DataError(fmt::format("{}; remove the folder {}, and the next run generates it again",
                                error.what(), kept.path().string()));
  }
}

// Warnings for readers of the run's numbers, from the generation of the sequence and from its
// verification. DataError if the sequence, or a subject from elsewhere, is inconsistent.
std::vector<std::string> WarningsOf(const RunPlan& run, const SequenceReader& sequence) {
  const Json& made = sequence.info().provenance;
  std::vector<std::string> warnings;
  if (made.contains("warnings") && made.at("warnings").is_array()) {
    for (const Json& warning : made.at("warnings")) {
      if (warning.is_string()) warnings.push_back(warning.get<std::string>());
    }
  }
  const auto add = [&](const std::vector<std::string>& found) {
    for (const std::string& warning : found) {
      if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end())
        warnings.push_back(warning);
    }
  };
  add(RequireConsistent(sequence, FrameSelection::kSample, sequence.folder()));
  if (!run.subject_folder.empty())
    add(RequireConsistent(ReadBodyModel(run.subject_folder), run.subject_folder));
  return warnings;
}

BodyModel UndamagedSubject(const RunPlan& run, const SequenceReader& sequence,
                           const WorkFolders& work) {
  if (run.subject) return ObtainFittedSubject(*run.subject, run.scene_settings, work.learned);
  if (!run.subject_folder.empty()) return ReadBodyModel(run.subject_folder);
  return sequence.subject();
}

BodyModel SubjectOf(const RunPlan& run, const SequenceReader& sequence, const WorkFolders& work) {
  BodyModel subject = UndamagedSubject(run, sequence, work);
  DamageSubject(run.faults.subject, subject);
  return subject;
}

// True joints in the order of the bones; DataError if the sequence does not hold all of them.
std::vector<Vector3d> JointsOfBones(const SequenceReader& sequence, int frame) {
  const std::vector<std::string>& names = sequence.info().joints;
  std::vector<Vector3d> joints;
  for (const BoneInfo& bone : Bones()) {
    const auto found = std::find(names.begin(), names.end(), bone.joint);
    const auto at = static_cast<std::size_t>(found - names.begin());
    if (found == names.end() || !sequence.true_joints(frame).Knows(at)) {
      throw DataError(
          fmt::format("{}: faults.depth.place \"bone\": the sequence has no true joint "
                      "{} in frame {}",
                      sequence.folder().string(), bone.joint, frame));
    }
    joints.push_back(sequence.true_joints(frame).positions[at]);
  }
  return joints;
}

void Track(const RunPlan& run, const SequenceReader& sequence, const WorkFolders& work,
           const fs::path& estimate_folder) {
  const BodyModel subject = SubjectOf(run, sequence, work);
  const DepthFaultSettings& faults = run.faults.depth;
  FaultContext context{sequence.info().depth_unit_m, run.seed, sequence.info().camera};
  const auto damage = [&](DepthFrame& frame) {
    if (const int shown = run.faults.view.ShownFrame(frame.index); shown != frame.index) {
      frame.depth = sequence.ReadDepth(shown);
      frame.time_s = shown / sequence.info().fps;
    }
    run.faults.view.DamageImage(frame.depth);
    if (faults.place == FaultPlace::kBone && faults.Damages(frame.index))
      context.bone = BoneSegments(faults.bone, JointsOfBones(sequence, frame.index));
    DamageFrame(faults, context, frame);
  };
  TrackSequence(sequence, run.faults.view.ToldCamera(sequence.info().camera), run.method, subject,
                damage, estimate_folder);
}

// The record's identity, settings and provenance, to which scores are added.
RunRecord RecordOf(const RunPlan& run, const std::string& experiment) {
  RunRecord record;
  record.run_id = run.run_id;
  record.experiment = experiment;
  record.variant = run.variant;
  record.scene = run.scene;
  record.method = run.method_name;
  record.seed = run.seed;
  record.config = WithPortablePaths(run.resolved);
  record.provenance = TimedProvenance();
  record.provenance["threads"] = run.method.settings.value("threads", 1);
  record.summary = {{"run_id", run.run_id},
                    {"variant", run.variant},
                    {"scene", run.scene},
                    {"seed", run.seed},
                    {"method", run.method_name}};
  if (run.repeat > 0) record.summary["repeat"] = run.repeat;
  return record;
}

std::string LogOf(const EstimateReader& estimate) {
  std::string log;
  for (std::size_t i = 0; i < estimate.frames().size(); ++i) {
    const FrameEstimate& frame = estimate.frames()[i];
    if (frame.message.empty()) continue;
    log += fmt::format("frame {}: {}: {}\n", i, Name(frame.outcome), frame.message);
  }
  return log;
}

// What the recording tells of the pose in its first frame.
KnownJoints KnownOf(const SequenceInfo& info) {
  KnownJoints known;
  for (const StartJoint& start : info.start_pose) {
    known.joints.push_back({FindJoint(start.joint), start.position});
  }
  if (!known.joints.empty()) known.deviation_m = info.start_pose_accuracy_m;
  return known;
}

}  // namespace

void TrackSequence(const SequenceReader& sequence, const PinholeCamera& camera,
                   const MethodConfig& method, const BodyModel& subject,
                   const std::function<void(DepthFrame&)>& prepare, const fs::path& folder) {
  const SequenceInfo& info = sequence.info();
  ForgetPeakMemory();
  const double before_mb = ResidentMemory_mb();
  const double diagonal_m = BoundingBoxDiagonal(subject.rest.vertices);
  const std::unique_ptr<Tracker> tracker = MakeTracker(method);
  EstimateWriter writer(folder, subject.rest);
  Progress progress("track " + method.method, info.frames);
  const KnownJoints known = KnownOf(info);
  tracker->Start(subject, camera);
  for (int i = 0; i < info.frames; ++i) {
    DepthFrame frame{i, i / info.fps, sequence.ReadDepth(i), i == 0 ? known : KnownJoints()};
    prepare(frame);
    const Stopwatch watch;
    TrackResult result = tracker->TrackFrame(frame);
    const double frame_ms = watch.ElapsedMs();
    MarkAstray(frame, camera, diagonal_m, result);
    writer.Append(result, frame_ms);
    progress.Advance();
  }
  writer.Finish(std::max(0.0, PeakMemory_mb() - before_mb));
}

BodyModel TrackedSubject(const PlannedRun& planned, const SequenceReader& sequence) {
  return SubjectOf(ReadSubjectPlan(planned), sequence, planned.work);
}

RunRecord CarryOutTracking(const PlannedRun& planned, const fs::path& run_folder) {
  const RunPlan run = ReadRunPlan(planned);
  const SequenceReader sequence = ObtainSequence(run, planned.work);
  std::vector<std::string> warnings = WarningsOf(run, sequence);
  Track(run, sequence, planned.work, run_folder / "estimate");
  RunRecord record = RecordOf(run, planned.experiment);
  record.sequence_folder =
      fs::absolute(sequence.folder()).lexically_relative(fs::absolute(run_folder.parent_path()));
  record.sequence_hash = sequence.hash();
  record.warnings = std::move(warnings);
  const EstimateReader estimate(run_folder / "estimate");
  ScoreRun(sequence, estimate, run.score, record);
  AddSummaries(sequence, estimate, planned.summaries, record);
  WriteWholeFile(run_folder / "log", LogOf(estimate));
  return record;
}

}  // namespace vitruvia
