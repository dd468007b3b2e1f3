#include "experiments/cli/learn_joints_command.h"

#include <memory>

#include <CLI/CLI.hpp>

#include "config/json_settings.h"
#include "core/error.h"
#include "math/statistics.h"
#include "sequence/sequence.h"
#include "subjects/learned_joints.h"
#include "synth/sensor/joint_stand_in.h"
#include "tracking/joint_observations.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

struct LearnJointsArguments {
  fs::path config, output;
  int threads = 2;
};

bool IsLearnt(const fs::path& folder, const Json& settings) {
  return fs::exists(folder / joints::kJointModelFile) && joints::ReadLearntFrom(folder) == settings;
}

void Print(const DetectionErrors& errors) {
  fmt::print(
      "{} images of other people in other poses, each scaled to 1.6 m from ankle to crown\n"
      "{:<16} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
      errors.images, "point", "found %", "mean mm", "2 cm %", "5 cm %", "10 cm %");
  const auto print = [](const std::string& name, double found, double mean_m, double within_2_cm,
                        double within_5_cm, double within_10_cm) {
    fmt::print("{:<16} {:>9.1f} {:>9.1f} {:>9.1f} {:>9.1f} {:>9.1f}\n", name, 100.0 * found,
               1e3 * mean_m, 100.0 * within_2_cm, 100.0 * within_5_cm, 100.0 * within_10_cm);
  };
  for (int p = 0; p < kBodyPointCount; ++p) {
    print(BodyPoints()[p].name, errors.found[p], errors.mean_m[p], errors.within_2_cm[p],
          errors.within_5_cm[p], errors.within_10_cm[p]);
  }
  print("all", Mean(errors.found), Mean(errors.mean_m), Mean(errors.within_2_cm),
        Mean(errors.within_5_cm), Mean(errors.within_10_cm));
}

void LearnJointsFromConfig(const LearnJointsArguments& a) {
  const auto settings = ReadSettingsFile<JointLearningSettings>(a.config);
  const Json resolved = WriteSettings(settings);
  if (IsLearnt(a.output, resolved)) {
    fmt::print("{}: learnt with these settings already; delete it to learn again\n",
               a.output.string());
    return;
  }
  const joints::JointModel model = LearnJointModel(settings, a.threads);
  joints::WriteJointModel(a.output, model, resolved);
  Print(TestJointModel(model, settings, a.threads));
  fmt::print("{}\n", a.output.string());
}

struct StandInArguments {
  fs::path sequence, settings, output;
};

JointObservations StandInFor(const SequenceReader& sequence, const JointStandInSettings& settings) {
  JointObservations observations;
  observations.source = "a stand-in for a joint detector: " + StandInDescription(settings);
  observations.joints = sequence.info().joints;
  for (int frame = 0; frame < sequence.info().frames; ++frame) {
    const JointTruth& truth = sequence.true_joints(frame);
    std::vector<bool> known;
    for (std::size_t j = 0; j < truth.positions.size(); ++j) known.push_back(truth.Knows(j));
    observations.frames.push_back({StandInJoints(settings, truth.positions, known, frame)});
  }
  return observations;
}

void WriteStandIn(const StandInArguments& a) {
  const auto settings = a.settings.empty() ? JointStandInSettings()
                                           : ReadSettingsFile<JointStandInSettings>(a.settings);
  const SequenceReader sequence(a.sequence);
  if (sequence.info().joints.empty()) {
    throw DataError(a.sequence.string() + ": has no true joints; expected some to add noise to");
  }
  WriteStored(a.output, StandInFor(sequence, settings), -1);
  fmt::print("{}: {}\n", a.output.string(), StandInDescription(settings));
}

}  // namespace

void AddLearnJointsCommand(CLI::App& learn) {
  auto a = std::make_shared<LearnJointsArguments>();
  CLI::App* command = learn.add_subcommand(
      "joints", "Learn a joint detector from synthetic depth; print its errors on other people");
  command->add_option("CONFIG", a->config, "joint learning file")->required();
  command->add_option("-o,--output", a->output, "folder of the joint model")->required();
  command->add_option("--threads", a->threads, "threads; the model is the same for any number")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->callback([a] { LearnJointsFromConfig(*a); });
}

void AddStandInJointsCommand(CLI::App& app) {
  auto a = std::make_shared<StandInArguments>();
  CLI::App* command = app.add_subcommand(
      "stand-in-joints",
      "Write a sequence's true joints with given noise, as a stand-in for a joint detector");
  command->add_option("SEQUENCE", a->sequence, "folder of the sequence")->required();
  command->add_option("--settings", a->settings, "JSON file of the noise");
  command->add_option("-o,--output", a->output, "file of joint observations")->required();
  command->footer(
      "A tracker that is given this file knows more than a depth camera shows. Results say so.");
  command->callback([a] { WriteStandIn(*a); });
}

}  // namespace vitruvia
