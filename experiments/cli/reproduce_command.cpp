#include "experiments/cli/reproduce_command.h"

#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>

#include "analysis/reproduction_list.h"
#include "config/json_settings.h"
#include "core/error.h"
#include "experiments/cli/run_command.h"
#include "experiments/plan/experiment_config.h"
#include "experiments/studies/reproduction.h"
#include "reports/pages/reproduction_page.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kFooter =
    "Figures of Stanford EVAL are made from the synthetic set in its spirit, or from your own\n"
    "recordings where VITRUVIA_EVAL names the folder that holds the sequences S0 … S7\n"
    "(vitruvia import eval). Figures whose data you do not have are on the page with the reason.\n"
    "Can be interrupted; the next call goes on. docs/reproduction.md explains the list file.\n"
    "Exit codes: 0 page written; 4 page written, but some run failed.";

struct ReproduceArguments {
  fs::path list = "configs/reproduction.json", output = "out/reproduction";
  std::vector<std::string> only;
  int jobs = 1;
  bool lists = false;
};

void PrintList(const std::vector<ReproducedFigure>& figures) {
  for (const ReproducedFigure& figure : figures) {
    fmt::print("{:<4} {}: {}\n", figure.id, figure.place, figure.title);
    for (const fs::path& experiment : figure.experiments)
      fmt::print("       {}\n", experiment.lexically_normal().generic_string());
  }
}

// "index.html", or named after the chosen figures, so that a part does not replace the whole.
std::string PageName(const ReproductionList& list, const std::vector<ReproducedFigure>& chosen) {
  if (chosen.size() == list.figures.size()) return "index.html";
  std::vector<std::string> ids;
  for (const ReproducedFigure& figure : chosen) ids.push_back(figure.id);
  return fmt::format("{}.html", fmt::join(ids, "-"));
}

int FailedRuns(const std::vector<FigureRecords>& figures) {
  std::vector<std::string> failed;
  for (const FigureRecords& figure : figures) {
    for (const ReportedExperiment& experiment : figure.experiments) {
      for (const ReportedRun& run : experiment.runs) {
        if (!run.record) failed.push_back(experiment.record.name + "/" + run.run_id);
      }
    }
  }
  std::sort(failed.begin(), failed.end());
  return static_cast<int>(std::unique(failed.begin(), failed.end()) - failed.begin());
}

void PrintVerdicts(const std::vector<FigureRecords>& figures) {
  for (const FigureRecords& records : figures) {
    const ClaimDecision decision = DecideFigure(records);
    fmt::print("{:<4} {:<22} {}\n", records.figure.id, Name(decision.verdict), decision.reason);
  }
}

void Reproduce(const ReproduceArguments& a) {
  const auto list = ReadSettingsFile<ReproductionList>(a.list);
  const std::vector<ReproducedFigure> figures = WithOwnEval(ChosenFigures(list, a.only));
  if (a.lists) return PrintList(figures);
  const CarriedOutFigures result = CarryOutFigures(list, figures, a.output, a.jobs);
  PrintVerdicts(result.figures);
  for (const ExperimentTime& time : result.times)
    fmt::print("{:>7.1f} s  {}\n", time.seconds, ConfigName(time.experiment));
  const fs::path page = a.output / PageName(list, figures);
  WriteReproductionPage(list, result.figures, page);
  fmt::print("page: {}\n", page.string());
  if (const int failed = FailedRuns(result.figures); failed > 0)
    throw RunError(fmt::format("{} runs failed", failed));
}

}  // namespace

void AddReproduceCommand(CLI::App& app) {
  auto a = std::make_shared<ReproduceArguments>();
  CLI::App* reproduce = app.add_subcommand(
      "reproduce",
      "Reproduce the papers' figures and tables on one page, with a verdict on each claim");
  reproduce->add_option("LIST", a->list, "list file; configs/reproduction.json without");
  reproduce->add_option("-o,--output", a->output,
                        "folder of the page and of its runs; out/reproduction without");
  reproduce->add_option("--only", a->only, "only these figures: A11,B4")->delimiter(',');
  reproduce->add_flag("--list", a->lists, "only print the figures and their experiments");
  reproduce
      ->add_option("-j,--jobs", a->jobs,
                   "number of concurrent runs; timed runs are executed one by one")
      ->check(CLI::Range(1, kMostJobs));
  reproduce->footer(kFooter);
  reproduce->callback([a] { Reproduce(*a); });
}

}  // namespace vitruvia
