#include "scoring/score.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "math/statistics.h"
#include "scoring/joint_score.h"
#include "scoring/run_health.h"
#include "scoring/surface_score.h"

namespace vitruvia {
namespace {

void RequireSameFrames(const SequenceReader& sequence, const EstimateReader& estimate) {
  if (static_cast<int>(estimate.frames().size()) == sequence.info().frames) return;
  throw DataError(fmt::format("{}: the estimate has {} frames, the sequence {}",
                              sequence.folder().string(), estimate.frames().size(),
                              sequence.info().frames));
}

void RecordOutcomes(const EstimateReader& estimate, RunRecord& record) {
  for (const FrameEstimate& frame : estimate.frames()) {
    record.frames["frame_ms"].push_back(frame.frame_ms);
    record.frames["iterations"].push_back(frame.iterations);
    record.frames["failed"].push_back(IsFailure(frame.outcome) ? 1.0 : 0.0);
    record.frames["condition"].push_back(frame.condition);
    record.frames["rotation_drift"].push_back(frame.rotation_drift);
    record.frames["energy_rise"].push_back(frame.energy_rise);
    for (const NamedValue& energy : frame.energies)
      record.frames["energy_" + energy.name].push_back(energy.value);
  }
}

std::vector<RunRecord::Step> StepTimes(const EstimateReader& estimate) {
  std::vector<RunRecord::Step> steps;
  for (std::size_t k = 0; k < estimate.frames().front().step_ms.size(); ++k) {
    std::vector<double> ms;
    for (const FrameEstimate& frame : estimate.frames()) ms.push_back(frame.step_ms.at(k).value);
    steps.push_back({estimate.frames().front().step_ms[k].name, Quantile(ms, 0.5),
                     Quantile(ms, 0.95), Maximum(ms)});
  }
  return steps;
}

// What could not be measured for want of truth, for people; "" if all was. A number that is absent
// must not be taken for a zero.
std::string NotScored(const SequenceInfo& info) {
  const UnmatchedJoints unmatched = FindUnmatchedJoints(info.joints);
  std::vector<std::string> parts;
  if (!info.surface) parts.emplace_back("surface: the sequence has no true surface");
  if (info.joints.empty()) {
    parts.emplace_back("joints: the sequence has no true joints");
  } else if (!unmatched.only_in_skeleton.empty()) {
    parts.push_back(
        fmt::format("joints without truth: {}", fmt::join(unmatched.only_in_skeleton, ", ")));
  }
  if (!unmatched.only_in_sequence.empty()) {
    parts.push_back(fmt::format("joints that the skeleton has not: {}",
                                fmt::join(unmatched.only_in_sequence, ", ")));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

void SummarizeRun(const SequenceInfo& info, RunRecord& record) {
  const auto& f = record.frames;
  const std::vector<double>& frame_ms = f.at("frame_ms");
  nlohmann::json& row = record.summary;
  row["frames"] = frame_ms.size();
  row["frames_failed"] =
      static_cast<int>(Mean(f.at("failed")) * static_cast<double>(frame_ms.size()) + 0.5);
  row["frame_ms_median"] = Quantile(frame_ms, 0.5);
  row["frame_ms_p95"] = Quantile(frame_ms, 0.95);
  row["frame_ms_max"] = Maximum(frame_ms);
  row["iterations_mean"] = Mean(f.at("iterations"));
  if (!record.variant.empty()) row["case"] = record.variant;
  if (const std::string missing = NotScored(info); !missing.empty()) row["not_scored"] = missing;
  SummarizeHealth(record, row);
}

}  // namespace

void ScoreSettings::Describe(Fields& f) {
  f.Integer(
      "reconstruction_every", reconstruction_every,
      {.meaning = "every how many frames visible vertices are held against the observed points "
                  "and against the true surface; 0 is never",
       .unit = "frames",
       .min = 0,
       .max = 1e6,
       .origin = Origin::kInput});
}

void ScoreRun(const SequenceReader& sequence, const EstimateReader& estimate,
              const ScoreSettings& settings, RunRecord& record) {
  RequireSameFrames(sequence, estimate);
  ScoreSurfaces(sequence, estimate, settings.reconstruction_every, record);
  ScoreJoints(sequence, estimate, record);
  RecordOutcomes(estimate, record);
  record.steps = StepTimes(estimate);
  SummarizeRun(sequence.info(), record);
  if (estimate.tracker_memory_mb()) {
    record.summary["tracker_memory_mb"] = *estimate.tracker_memory_mb();
  }
}

}  // namespace vitruvia
