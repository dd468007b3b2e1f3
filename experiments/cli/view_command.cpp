#include "experiments/cli/view_command.h"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/error.h"
#include "reports/viewer/viewer.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

struct ViewArguments {
  std::vector<fs::path> runs;
  fs::path page;
  ViewerLimits limits;
};

void View(const ViewArguments& arguments) {
  fs::path page = arguments.page;
  if (page.empty()) {
    if (arguments.runs.size() > 1)
      throw ConfigError("view: expected -o PAGE.html, since there are several runs");
    page = arguments.runs.front() / kViewerPage;
  }
  WriteViewer(arguments.runs, arguments.limits, page);
  fmt::print("{}: {:.1f} MB\n", page.string(), 1e-6 * static_cast<double>(fs::file_size(page)));
}

}  // namespace

void AddViewCommand(CLI::App& app) {
  auto a = std::make_shared<ViewArguments>();
  CLI::App* command = app.add_subcommand(
      "view", "Write a page in which runs are seen in three dimensions, in lockstep");
  command->add_option("RUN", a->runs, "folders of runs: EXPERIMENT/RUN_ID")->required();
  command->add_option("-o,--output", a->page, "the page; of a single run RUN/view.html without it");
  command
      ->add_option("--frames", a->limits.most_frames,
                   "most frames with surfaces and depth; further frames have numbers and joints")
      ->capture_default_str()
      ->check(CLI::Range(2, 100'000));
  command
      ->add_option("--vertices", a->limits.most_vertices,
                   "most vertices of a surface; larger meshes are thinned")
      ->capture_default_str()
      ->check(CLI::Range(100, 1'000'000));
  command->callback([a] { View(*a); });
}

}  // namespace vitruvia
