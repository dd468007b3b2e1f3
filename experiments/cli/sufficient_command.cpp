#include "experiments/cli/sufficient_command.h"

#include <memory>

#include <CLI/CLI.hpp>

#include "core/files.h"
#include "experiments/cli/argument_checks.h"
#include "experiments/studies/sufficient.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr int kMostSufficientJobs = 1024;

struct SufficientArguments {
  fs::path experiment, output;
  SufficiencySettings settings;
};

void PrintSufficiency(const Sufficiency& result, const SufficiencySettings& settings) {
  const auto print = [&](const std::string& what, const ModelCost& cost, const std::string& note) {
    fmt::print("{:<36} {:>12.6g} {:>+9.1f} % {:>10.2f} {:>+9.1f} %  {}\n", what, cost.error,
               100.0 * (cost.error_ratio - 1.0), cost.frame_ms,
               100.0 * (cost.frame_ms / result.full.frame_ms - 1.0), note);
  };
  fmt::print("{:<36} {:>12} {:>11} {:>10} {:>11}\n", "model", settings.metric, "to full",
             "ms/frame", "to full");
  print("full", result.full, "");
  int number = 0;
  for (const SufficiencyRound& round : result.rounds) {
    fmt::print("round {}\n", ++number);
    for (const SufficiencyRound::Trial& trial : round.trials) {
      print("  without " + trial.part, trial.cost,
            trial.part == round.left_out ? "left out"
            : trial.is_sufficient        ? "sufficient"
                                         : "");
    }
  }
  std::string parts;
  for (const std::string& part : result.left_out) parts += (parts.empty() ? "" : ", ") + part;
  print("smallest", result.smallest,
        parts.empty() ? "nothing can be left out" : "without " + parts);
}

void FindAndPrint(const SufficientArguments& a) {
  const fs::path folder =
      a.output.empty() ? fs::path("out/sufficient") / ConfigName(a.experiment) : a.output;
  MakeFolder(folder);
  const Sufficiency result = FindSufficient(a.experiment, a.settings, folder);
  PrintSufficiency(result, a.settings);
  WriteWholeFile(folder / "sufficient.json", ToJson(result, a.settings).dump(2) + "\n");
  fmt::print("{}\n", (folder / "sufficient.json").string());
}

}  // namespace

void AddSufficientCommand(CLI::App& app) {
  const auto a = std::make_shared<SufficientArguments>();
  CLI::App* command = app.add_subcommand(
      "sufficient", "Find the smallest model whose error stays within a margin of the full one's");
  command
      ->add_option("EXPERIMENT", a->experiment,
                   "experiment file; the overrides of each variant leave one part out")
      ->required();
  command
      ->add_option(
          "--margin", a->settings.margin,
          "allowed increase of the error over the full model's, relative to the full model's error")
      ->check(NumberIn(0.0, 10.0))
      ->capture_default_str();
  command
      ->add_option("--metric", a->settings.metric,
                   "key of a metric for which lower is better (vitruvia explain)")
      ->capture_default_str();
  command->add_option("-o,--output", a->output,
                      "folder of the runs; without it out/sufficient/NAME");
  command
      ->add_option("-j,--jobs", a->settings.jobs,
                   "number of concurrent runs; with more than one, times are less accurate")
      ->check(CLI::Range(1, kMostSufficientJobs));
  command->callback([a] { FindAndPrint(*a); });
}

}  // namespace vitruvia
