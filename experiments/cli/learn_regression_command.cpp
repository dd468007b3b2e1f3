#include "experiments/cli/learn_regression_command.h"

#include <memory>

#include <CLI/CLI.hpp>

#include "config/json_settings.h"
#include "core/error.h"
#include "subjects/learned_regression.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

struct LearnRegressionArguments {
  fs::path config, output;
};

void LearnRegressionFromConfig(const LearnRegressionArguments& a) {
  const auto settings = ReadSettingsFile<RegressionLearningSettings>(a.config);
  const Json resolved = WriteSettings(settings);
  if (fs::exists(a.output / kPoseRegressionFile) && ReadRegressionOrigin(a.output) == resolved) {
    fmt::print("{}: learnt with these settings already; delete it to learn again\n",
               a.output.string());
    return;
  }
  const LearnedRegression learnt = LearnRegression(settings);
  WritePoseRegression(a.output, learnt.regression, resolved);
  const RegressionErrors& errors = learnt.errors;
  fmt::print(
      "surfaces of true part rotations against pose examples, mean distance\n"
      "{:<40} {:>8.2f} mm\n{:<40} {:>8.2f} mm\n{:<40} {:>8.2f} mm\n{}\n",
      "people learnt from", 1e3 * errors.training_mean_m, "people held out",
      1e3 * errors.held_out_mean_m, "people held out, without deformations",
      1e3 * errors.without_mean_m, a.output.string());
}

}  // namespace

void AddLearnRegressionCommand(CLI::App& learn) {
  auto a = std::make_shared<LearnRegressionArguments>();
  CLI::App* command = learn.add_subcommand(
      "pose-regression",
      "Learn the deformation of triangles with the pose; print the errors on held-out people");
  command->add_option("CONFIG", a->config, "file of the people and the regression")->required();
  command->add_option("-o,--output", a->output, "folder of the pose regression")->required();
  command->callback([a] { LearnRegressionFromConfig(*a); });
}

}  // namespace vitruvia
