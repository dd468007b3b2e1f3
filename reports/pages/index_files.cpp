// Collects what the index shows from an output folder.
#include <algorithm>

#include <fmt/format.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include "analysis/gate_reports.h"
#include "core/error.h"
#include "core/files.h"
#include "reports/figures/history_figure.h"
#include "reports/pages/index_page.h"

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

ColorImage ReadPng(const fs::path& file) {
  vtkNew<vtkPNGReader> reader;
  if (reader->CanReadFile(file.c_str()) == 0)
    throw DataError(fmt::format("{}: not a PNG", file.string()));
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkImageData* data = reader->GetOutput();
  const int* size = data->GetDimensions();
  const int channels = data->GetNumberOfScalarComponents();
  ColorImage image(size[0], size[1]);
  for (int v = 0; v < size[1]; ++v) {
    for (int u = 0; u < size[0]; ++u) {
      const auto* pixel =
          static_cast<const std::uint8_t*>(data->GetScalarPointer(u, size[1] - 1 - v, 0));
      image(u, v) = {pixel[0], pixel[channels > 2 ? 1 : 0], pixel[channels > 2 ? 2 : 0], 255};
    }
  }
  return image;
}

// Means over the pixels that fall into one: the top of a picture, smaller.
ColorImage Thumbnail(const ColorImage& image) {
  const int factor = std::max(1, (image.width() + kThumbnailWidth - 1) / kThumbnailWidth);
  const int width = image.width() / factor;
  const int height = std::min(image.height() / factor, static_cast<int>(kThumbnailAspect * width));
  ColorImage small(width, height);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      std::array<int, 3> sum{};
      for (int k = 0; k < factor * factor; ++k) {
        const ColorPixel& pixel = image(u * factor + k % factor, v * factor + k / factor);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += pixel[c];
      }
      for (std::size_t c = 0; c < 3; ++c)
        small(u, v)[c] = static_cast<std::uint8_t>(sum[c] / (factor * factor));
      small(u, v)[3] = 255;
    }
  }
  return small;
}

IndexedExperiment ReadIndexed(const fs::path& folder, const fs::path& top) {
  IndexedExperiment indexed;
  indexed.experiment = ReadExperiment(folder);
  if (fs::exists(folder / kPage))
    indexed.link = (folder / kPage).lexically_relative(top).generic_string();
  const fs::path speed = folder / "figures" / "speed-against-error.svg";
  if (fs::exists(speed)) indexed.speed_svg = ReadWholeFile(speed);
  for (const ReportedRun& run : indexed.experiment.runs) {
    const fs::path pictures = folder / "figures" / ("pictures-" + run.run_id + ".png");
    if (!fs::exists(pictures)) continue;
    indexed.picture_png = EncodePng(Thumbnail(ReadPng(pictures)));
    break;
  }
  return indexed;
}

IndexedGate ReadGate(const fs::path& folder, const fs::path& top, DrawingWriter& writer) {
  const auto file = ReadStored<RegressionFile>(folder / "regression.json");
  IndexedGate gate{file.name,
                   file.verdict,
                   file.date,
                   file.commit,
                   (folder / "regression.md").lexically_relative(top).generic_string(),
                   {}};
  for (const Figure& figure : MakeHistoryFigures(ReadHistory(folder / "history.json"))) {
    const fs::path stem = folder / figure.name;
    writer.Write(stem, kFigureWidth, FigureHeight(figure),
                 [&](Canvas& canvas) { DrawFigure(canvas, figure); });
    gate.figures.push_back(
        {figure.name, figure.title, figure.caption, ReadWholeFile(fs::path(stem).concat(".svg"))});
  }
  return gate;
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
  DrawingWriter writer;
  for (const fs::path& gate : found.gates) {
    reading(gate, [&](const fs::path& place) {
      content.gates.push_back(ReadGate(place, folder, writer));
    });
  }
  if (content.experiments.empty() && content.gates.empty() && content.problems.empty())
    throw DataError(fmt::format("{}: holds no experiment", folder.string()));
  const fs::path page = folder / "index.html";
  WriteWholeFile(page, MakeIndexPage(content));
  return page;
}

}  // namespace vitruvia
