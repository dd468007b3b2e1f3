#include "reports/pages/report.h"

#include "analysis/tables.h"
#include "core/files.h"
#include "reports/figures/run_plots.h"
#include "reports/pages/html_page.h"
#include "reports/pictures/pictures.h"
#include "reports/pictures/side_by_side.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kFiguresMark = "README";

void WritePictureSheets(DrawingWriter& writer, const std::vector<RunPictures>& pictures,
                        const fs::path& folder) {
  for (const RunPictures& run : pictures) {
    if (run.strips.empty()) continue;
    WritePictureSheet(writer, folder / ("pictures-" + run.run_id), run);
  }
}

}  // namespace

fs::path WriteReport(const fs::path& experiment_folder) {
  const ReportedExperiment experiment = ReadExperiment(experiment_folder);

  DrawingWriter writer;
  StagedFolder figures_folder(experiment_folder / "figures", kFiguresMark);
  WriteWholeFile(figures_folder.path() / kFiguresMark,
                 "Drawn by vitruvia; drawn anew with each report.\n");
  const std::vector<DrawnFigure> figures =
      DrawFigures(writer, MakeFigures(experiment), figures_folder.path());
  std::vector<RunPictures> pictures = MakeSideBySide(experiment);
  for (RunPictures& run : MakePictures(experiment)) pictures.push_back(std::move(run));
  WritePictureSheets(writer, pictures, figures_folder.path());
  figures_folder.Commit();

  WriteWholeFile(experiment_folder / "table.csv", ToCsv(experiment));
  WriteWholeFile(experiment_folder / "table.tex", ToLatex(experiment));
  const fs::path page = experiment_folder / "report.html";
  WriteWholeFile(page, MakePage(experiment, figures, pictures));
  return page;
}

}  // namespace vitruvia
