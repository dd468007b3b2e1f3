#include "experiments/cli/rescore_command.h"

#include <memory>

#include <CLI/CLI.hpp>

#include "core/error.h"
#include "experiments/cli/experiment_folder.h"
#include "experiments/cli/problems.h"
#include "experiments/plan/experiment_config.h"
#include "experiments/run/experiment_files.h"
#include "experiments/run/run_state.h"
#include "scoring/rescore.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

// Without the provenance, which says who computed the metrics.
nlohmann::json ResultsOf(const RunRecord& record) {
  nlohmann::json json = StoredJson(record);
  json.erase("provenance");
  return json;
}

// Returns whether any number changed.
bool RescoreRun(const fs::path& folder, const std::string& run_id,
                const std::vector<FrameSummary>& summaries) {
  const std::optional<FileLock> claim = ClaimRun(folder / run_id);
  if (!claim) throw RunError(fmt::format("{}: another process carries it out", run_id));
  const RunRecord before = ReadRunRecord(folder, run_id);
  const RunRecord after = Rescored(folder, before, summaries);
  WriteRunRecord(folder, after);
  return ResultsOf(before) != ResultsOf(after);
}

void Rescore(const fs::path& folder, const std::string& only) {
  int rescored = 0, changed = 0;
  SkippedRuns skipped;
  const ExperimentRecord experiment = ReadExperimentRecord(folder);
  for (const std::string& run_id : RunsMatching(experiment, only)) {
    if (!fs::exists(folder / run_id / "record.json")) continue;
    if (!fs::is_directory(folder / run_id / "estimate")) {
      fmt::print("{}: has no estimate, its record stays as it is\n", run_id);
      continue;
    }
    skipped.SkipIfUnreadable(run_id, [&] {
      const bool differs = RescoreRun(folder, run_id, experiment.summaries);
      fmt::print("{}: {}\n", run_id, differs ? "changed" : "the same");
      ++rescored;
      changed += differs ? 1 : 0;
    });
  }
  if (rescored + skipped.count() == 0)
    throw DataError(fmt::format("{}: holds no run to score again", folder.string()));
  WriteSummary(folder);
  fmt::print("{} runs scored again, {} changed; vitruvia report {} draws them\n", rescored, changed,
             folder.string());
  skipped.RequireNone(folder);
}

// What the experiment file says now of how runs are summarised and shown goes into the folder.
void TakeOverPresentation(const fs::path& experiment_file, const fs::path& folder) {
  const auto settings = ReadSettingsFile<ExperimentSettings>(experiment_file);
  const FileLock lock = LockExperiment(folder);
  ExperimentRecord record = ReadExperimentRecord(folder);
  record.summaries = settings.summaries;
  record.table_columns = settings.table_columns;
  WriteExperimentRecord(folder, record);
}

bool IsTrackingExperiment(const fs::path& file) {
  return fs::is_regular_file(file) &&
         ReadJsonFile(file).value("kind", std::string(kTrackingKind)) == kTrackingKind;
}

}  // namespace

void AddRescoreCommand(CLI::App& app) {
  struct RescoreArguments {
    fs::path experiment, output;
    std::string only;
  };
  auto a = std::make_shared<RescoreArguments>();
  CLI::App* rescore = app.add_subcommand(
      "rescore", "Recompute all metrics from stored estimates, without tracking");
  AddExperimentArgument(*rescore, a->experiment, a->output);
  AddOnlyOption(*rescore, a->only);
  rescore->footer(
      "Given the experiment file, its summaries and table_columns replace those of the folder.");
  rescore->callback([a] {
    const fs::path folder = ExperimentFolder(a->experiment, a->output);
    if (IsTrackingExperiment(a->experiment)) TakeOverPresentation(a->experiment, folder);
    Rescore(folder, a->only);
  });
}

}  // namespace vitruvia
