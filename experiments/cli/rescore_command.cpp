#include "experiments/cli/rescore_command.h"

#include <memory>

#include <CLI/CLI.hpp>

#include "core/error.h"
#include "experiments/plan/run_selection.h"
#include "experiments/run/run_state.h"
#include "experiments/run/runner.h"
#include "scoring/rescore.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

// Metrics only: who computed them is no result.
nlohmann::json ResultsOf(const RunRecord& record) {
  nlohmann::json json = StoredJson(record);
  json.erase("provenance");
  return json;
}

// Returns whether any number changed.
bool RescoreRun(const fs::path& folder, const std::string& run_id) {
  const std::optional<FileLock> claim = ClaimRun(folder / run_id);
  if (!claim) throw RunError(fmt::format("{}: is being carried out by another process", run_id));
  const RunRecord before = ReadRunRecord(folder, run_id);
  const RunRecord after = Rescored(folder, before);
  WriteRunRecord(folder, after);
  return ResultsOf(before) != ResultsOf(after);
}

void Rescore(const fs::path& folder, const std::string& only) {
  int rescored = 0, changed = 0;
  for (const std::string& run_id : ReadExperimentRecord(folder).run_ids) {
    if (!only.empty() && !MatchesPattern(only, run_id)) continue;
    if (!fs::exists(folder / run_id / "record.json")) continue;
    if (!fs::is_directory(folder / run_id / "estimate")) {
      fmt::print("{}: has no estimate, its record stays as it is\n", run_id);
      continue;
    }
    const bool differs = RescoreRun(folder, run_id);
    fmt::print("{}: {}\n", run_id, differs ? "changed" : "the same");
    ++rescored;
    changed += differs ? 1 : 0;
  }
  if (rescored == 0)
    throw DataError(fmt::format("{}: holds no run to score again", folder.string()));
  WriteSummary(folder);
  fmt::print("{} runs scored again, {} changed; vitruvia report {} draws them\n", rescored, changed,
             folder.string());
}

}  // namespace

void AddRescoreCommand(CLI::App& app) {
  struct RescoreArguments {
    fs::path folder;
    std::string only;
  };
  auto a = std::make_shared<RescoreArguments>();
  CLI::App* rescore = app.add_subcommand(
      "rescore", "Compute all metrics again from stored estimates, without tracking");
  rescore->add_option("DIR", a->folder, "the experiment's folder")->required();
  rescore->add_option("--only", a->only, "only runs whose id matches this pattern (* ? [abc])");
  rescore->callback([a] { Rescore(a->folder, a->only); });
}

}  // namespace vitruvia
