#include "experiments/cli/view_command.h"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "analysis/experiment_runs.h"
#include "core/error.h"
#include "experiments/cli/problems.h"
#include "reports/pages/report.h"
#include "reports/viewer/viewer.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

struct ViewArguments {
  std::vector<fs::path> runs;
  fs::path page;
  ViewerLimits limits;
};

void WritePage(const std::vector<fs::path>& runs, const ViewerLimits& limits,
               const fs::path& page) {
  WriteViewer(runs, limits, page);
  fmt::print("{}: {:.1f} MB\n", page.string(), 1e-6 * static_cast<double>(fs::file_size(page)));
}

bool IsUpToDate(const fs::path& page, const fs::path& run_folder) {
  return fs::exists(page) &&
         fs::last_write_time(page) > fs::last_write_time(run_folder / "record.json");
}

// A page for each run that has none, or that was run again since; then the report, which links
// them.
void ViewExperiment(const fs::path& folder, const ViewerLimits& limits) {
  const ReportedExperiment experiment = ReadExperiment(folder);
  SkippedRuns skipped;
  for (const RunRecord* run : experiment.finished()) {
    const fs::path run_folder = folder / run->run_id, page = run_folder / kViewerPage;
    if (!run->frames.empty() && !IsUpToDate(page, run_folder))
      skipped.SkipIfUnreadable(run->run_id, [&] { WritePage({run_folder}, limits, page); });
  }
  fmt::print("report: {}\n", WriteReport(folder).string());
  skipped.RequireNone(folder);
}

void View(const ViewArguments& arguments) {
  const auto& runs = arguments.runs;
  if (runs.size() == 1 && arguments.page.empty()) {
    if (fs::exists(runs.front() / "experiment.json"))
      return ViewExperiment(runs.front(), arguments.limits);
    return WritePage(runs, arguments.limits, runs.front() / kViewerPage);
  }
  if (arguments.page.empty())
    throw ConfigError("view: expected -o PAGE.html, since there are several runs");
  for (const fs::path& run : runs) {
    if (fs::exists(run / "experiment.json"))
      throw ConfigError(
          fmt::format("view: {} is an experiment's folder; expected folders of its runs for one "
                      "page, such as {}",
                      run.string(), (run / "RUN_ID").string()));
  }
  WritePage(runs, arguments.limits, arguments.page);
}

}  // namespace

void AddViewCommand(CLI::App& app) {
  auto a = std::make_shared<ViewArguments>();
  CLI::App* command =
      app.add_subcommand("view", "Write a page that shows runs synchronously in three dimensions");
  command
      ->add_option(
          "RUN", a->runs,
          "folders of runs, EXPERIMENT/RUN_ID, for one page; or an experiment's folder alone: a "
          "page for each of its runs")
      ->required();
  command->add_option("-o,--output", a->page,
                      "the page, of folders of runs; default for a single run: RUN/view.html");
  command
      ->add_option("--frames", a->limits.most_frames,
                   "maximum number of frames with surfaces and depth; further frames have only "
                   "numbers and joints")
      ->capture_default_str()
      ->check(CLI::Range(2, 100'000));
  command
      ->add_option("--vertices", a->limits.most_vertices,
                   "maximum number of vertices of a surface; larger meshes are decimated")
      ->capture_default_str()
      ->check(CLI::Range(100, 1'000'000));
  command->callback([a] { View(*a); });
}

}  // namespace vitruvia
