#include "scoring/score.h"

#include <algorithm>
#include <cmath>

#include "core/absent.h"
#include "core/error.h"
#include "math/statistics.h"
#include "scoring/joint_score.h"
#include "scoring/limb_score.h"
#include "scoring/observation_score.h"
#include "scoring/own_surface_score.h"
#include "scoring/run_health.h"
#include "scoring/surface_score.h"
#include "scoring/uncertainty_score.h"

namespace vitruvia {
namespace {

void RequireSameFrames(const SequenceReader& sequence, const EstimateReader& estimate) {
  if (static_cast<int>(estimate.frames().size()) == sequence.info().frames) return;
  throw DataError(fmt::format("{}: the estimate has {} frames, the sequence {}",
                              sequence.folder().string(), estimate.frames().size(),
                              sequence.info().frames));
}

bool HoldsAgainstObservation(const ScoreSettings& settings, const SequenceInfo& info) {
  switch (settings.against_observation) {
    case AgainstObservation::kWithoutTruth:
      return !info.surface && !info.own_surfaces;
    case AgainstObservation::kAlways:
      return true;
    case AgainstObservation::kNever:
      return false;
  }
  return false;
}

void RecordOutcomes(const EstimateReader& estimate, RunRecord& record) {
  const std::size_t count = estimate.frames().size();
  // A series exists if any frame has the value; frames without it hold NaN.
  const auto put = [&](const std::string& name, std::size_t frame, double value) {
    if (std::isnan(value)) return;
    record.frames.try_emplace(name, count, kAbsent).first->second[frame] = value;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const FrameEstimate& frame = estimate.frames()[i];
    put("frame_ms", i, frame.frame_ms);
    put("iterations", i, frame.iterations);
    put("failed", i, IsFailure(frame.outcome) ? 1.0 : 0.0);
    put("condition", i, frame.condition);
    put("rotation_drift", i, frame.rotation_drift);
    put("energy_rise", i, frame.energy_rise);
    put("weak_directions", i, frame.weak_directions);
    put("agreeing_digits", i, frame.agreeing_digits);
    for (const NamedValue& energy : frame.energies) put("energy_" + energy.name, i, energy.value);
  }
}

// Times of each step over the frames that carried it out, in the order of first appearance.
std::vector<RunRecord::Step> StepTimes(const EstimateReader& estimate) {
  std::vector<std::pair<std::string, std::vector<double>>> times;
  for (const FrameEstimate& frame : estimate.frames()) {
    for (const NamedValue& step : frame.step_ms) {
      const auto same_name = [&](const auto& known) { return known.first == step.name; };
      auto found = std::find_if(times.begin(), times.end(), same_name);
      if (found == times.end()) found = times.insert(times.end(), {step.name, {}});
      found->second.push_back(step.value);
    }
  }
  std::vector<RunRecord::Step> steps;
  for (const auto& [name, ms] : times)
    steps.push_back({name, Quantile(ms, 0.5), Quantile(ms, 0.95), Maximum(ms)});
  return steps;
}

// Text that names what could not be measured without truth; "" if everything was. It prevents an
// absent number from being taken for zero.
std::string NotScored(const SequenceInfo& info) {
  const UnmatchedJoints unmatched = FindUnmatchedJoints(info.joints);
  std::vector<std::string> parts;
  if (!info.surface && !info.own_surfaces)
    parts.emplace_back("surface: the sequence has no true surface");
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
      static_cast<int>(std::lround(Mean(f.at("failed")) * static_cast<double>(frame_ms.size())));
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
  f.Integer("reconstruction_every", reconstruction_every,
            {.meaning = "interval in frames at which visible vertices are compared with the "
                        "observed points and the true surface; 0: never",
             .unit = "frames",
             .min = 0,
             .max = 1e6,
             .origin = Origin::kInput});
  f.Choice("against_observation", against_observation,
           {{"without_truth", AgainstObservation::kWithoutTruth},
            {"always", AgainstObservation::kAlways},
            {"never", AgainstObservation::kNever}},
           {.meaning = "when the estimate is compared with the observed depth: only if the "
                       "sequence has no true surface, always, or never",
            .origin = Origin::kInput});
  f.Section("bound", bound,
            {.meaning = "the Cramér–Rao bound of single frames, from truth and sensor model"});
}

void ScoreRun(const SequenceReader& sequence, const EstimateReader& estimate,
              const ScoreSettings& settings, RunRecord& record) {
  RequireSameFrames(sequence, estimate);
  ScoreSurfaces(sequence, estimate, settings.reconstruction_every, record);
  ScoreOwnSurfaces(sequence, estimate, record);
  ScoreJoints(sequence, estimate, record);
  ScoreLimbs(sequence, estimate, record);
  ScoreUncertainty(sequence, estimate, record);
  ScoreBound(sequence, estimate, settings.bound, record);
  if (HoldsAgainstObservation(settings, sequence.info()))
    ScoreObservation(sequence, estimate, record);
  RecordOutcomes(estimate, record);
  record.steps = StepTimes(estimate);
  SummarizeRun(sequence.info(), record);
  if (estimate.tracker_memory_mb()) {
    record.summary["tracker_memory_mb"] = *estimate.tracker_memory_mb();
  }
}

}  // namespace vitruvia
