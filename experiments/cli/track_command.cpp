#include "experiments/cli/track_command.h"

#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>

#include "core/error.h"
#include "experiments/cli/argument_checks.h"
#include "experiments/plan/experiment_config.h"
#include "experiments/run/frame_failures.h"
#include "experiments/run/tracking_run.h"
#include "scoring/score.h"
#include "verification/verification.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

struct TrackArguments {
  fs::path method, sequence, subject, output;
  double failed_frames_limit = kFailedFramesLimit;
};

void Track(const TrackArguments& a) {
  const MethodConfig method = ReadMethodConfig(ReadJsonFile(a.method), {a.method, ""});
  const SequenceReader sequence(a.sequence);
  const BodyModel subject = a.subject.empty() ? sequence.subject() : ReadBodyModel(a.subject);
  RequireConsistent(sequence, FrameSelection::kSample, a.sequence);
  if (!a.subject.empty()) RequireConsistent(subject, a.subject);
  const auto as_stored = [](DepthFrame&) {};
  TrackSequence(sequence, sequence.info().camera, method, subject, as_stored, a.output);
  RunRecord record;
  ScoreRun(sequence, EstimateReader(a.output), ScoreSettings(), record);
  fmt::print("{}\n", record.summary.dump(2));
  const FrameFailures failures = FrameFailuresOf(record.summary);
  if (failures.AreAll())
    throw RunError(fmt::format("track: all of the {} frames failed", failures.frames));
  if (failures.AreMoreThan(a.failed_frames_limit))
    throw Error(ExitCode::kFramesFailed, "track: " + failures.Text(a.failed_frames_limit));
}

}  // namespace

void AddTrackCommand(CLI::App& app) {
  const auto a = std::make_shared<TrackArguments>();
  CLI::App* track = app.add_subcommand("track", "Track a sequence and score the result");
  track->add_option("METHOD", a->method, "method file")->required();
  track->add_option("--sequence", a->sequence, "folder of the sequence")->required();
  track->add_option("-o,--output", a->output, "folder of the estimate")->required();
  track->add_option("--subject", a->subject,
                    "folder of the tracker's subject; without it the sequence's own");
  track
      ->add_option("--failed-frames-limit", a->failed_frames_limit,
                   "share of the frames that may fail; with more the exit code is 8")
      ->check(NumberIn(0.0, 1.0))
      ->capture_default_str();
  track->footer(
      "The summary is printed and the estimate is kept however many frames failed.\n"
      "Exit codes: 0 tracked; 4 all frames failed; 8 more than --failed-frames-limit failed.");
  track->callback([a] { Track(*a); });
}

}  // namespace vitruvia
