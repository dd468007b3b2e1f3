#include "experiments/cli/learn_command.h"

#include <CLI/CLI.hpp>

#include "experiments/cli/learn_joints_command.h"
#include "experiments/cli/learn_regression_command.h"
#include "experiments/cli/learn_shape_command.h"
#include "experiments/cli/learn_weights_command.h"

namespace vitruvia {

void AddLearnCommand(CLI::App& app) {
  CLI::App* learn = app.add_subcommand("learn", "Learn the models that trackers need from bodies");
  learn->require_subcommand(1);
  AddLearnDatabaseCommand(*learn);
  AddLearnShapeCommand(*learn);
  AddLearnWeightsCommand(*learn);
  AddLearnComparisonCommand(*learn);
  AddLearnJointsCommand(*learn);
  AddLearnRegressionCommand(*learn);
}

}  // namespace vitruvia
