// Collects what the index shows from an output folder.
#include <algorithm>

#include <fmt/format.h>

#include "analysis/gate_reports.h"
#include "core/error.h"
#include "core/files.h"
#include "reports/drawing/thumbnail.h"
#include "reports/figures/history_figure.h"
#include "reports/pages/index_page.h"
#include "reports/pages/viewer_link.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kPage = "report.html";
constexpr int kThumbnailWidth = 760;       // pixels
constexpr double kThumbnailAspect = 0.55;  // its height is at most this share: the first strips

// Experiments and gates; what lies inside one belongs to it.
struct FoundFolders {
  std::vector<fs::path> experiments, gates;
};

FoundFolders FindFolders(const fs::path& folder) {
  FoundFolders found;
  for (auto entry = fs::recursive_directory_iterator(folder);
       entry != fs::recursive_directory_iterator(); ++entry) {
    if (!entry->is_directory()) continue;
    const bool is_gate = fs::is_regular_file(entry->path() / "regression.json");
    const bool is_experiment = fs::is_regular_file(entry->path() / "experiment.json");
    if (is_gate) found.gates.push_back(entry->path());
    if (is_experiment && !is_gate) found.experiments.push_back(entry->path());
    if (is_gate || is_experiment) entry.disable_recursion_pending();
  }
  std::sort(found.experiments.begin(), found.experiments.end());
  std::sort(found.gates.begin(), found.gates.end());
  return found;
}

IndexedExperiment ReadIndexed(const fs::path& folder, const fs::path& top) {
  IndexedExperiment indexed;
  indexed.experiment = ReadExperiment(folder);
  if (fs::exists(folder / kPage))
    indexed.link = (folder / kPage).lexically_relative(top).generic_string();
  const fs::path speed = folder / "figures" / "speed-against-error.svg";
  if (fs::exists(speed)) indexed.speed_svg = ReadWholeFile(speed);
  for (const ReportedRun& run : indexed.experiment.runs) {
    const std::string link = ViewerLink(folder, run.run_id, top);
    if (!link.empty()) indexed.viewers[run.run_id] = link;
  }
  for (const ReportedRun& run : indexed.experiment.runs) {
    const fs::path pictures = folder / "figures" / ("pictures-" + run.run_id + ".png");
    if (!fs::exists(pictures)) continue;
    indexed.picture_png =
        EncodePng(Thumbnail(ReadPng(pictures), kThumbnailWidth, kThumbnailAspect));
    break;
  }
  return indexed;
}

IndexedGate ReadGate(const fs::path& folder, const fs::path& top) {
  const auto file = ReadStored<RegressionFile>(folder / "regression.json");
  return {file.name,
          file.verdict,
          file.date,
          file.commit,
          (folder / "regression.md").lexically_relative(top).generic_string(),
          DrawFigures(MakeHistoryFigures(ReadHistory(folder / "history.json")), folder)};
}

}  // namespace

fs::path WriteIndex(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw DataError(fmt::format("{}: expected a folder of experiments", folder.string()));
  const FoundFolders found = FindFolders(folder);
  IndexContent content;
  const auto reading = [&](const fs::path& place, auto read) {
    try {
      read(place);
    } catch (const DataError& error) {  // one damaged record must not hide the others
      content.problems.emplace_back(error.what());
    }
  };
  for (const fs::path& experiment : found.experiments) {
    reading(experiment, [&](const fs::path& place) {
      content.experiments.push_back(ReadIndexed(place, folder));
    });
  }
  for (const fs::path& gate : found.gates) {
    reading(gate, [&](const fs::path& place) { content.gates.push_back(ReadGate(place, folder)); });
  }
  if (content.experiments.empty() && content.gates.empty() && content.problems.empty())
    throw DataError(fmt::format("{}: holds no experiment", folder.string()));
  const fs::path page = folder / "index.html";
  WriteWholeFile(page, MakeIndexPage(content));
  return page;
}

}  // namespace vitruvia
