#include "reports/pages/report.h"

#include "analysis/tables.h"
#include "analysis/text_table.h"
#include "core/files.h"
#include "reports/figures/run_plots.h"
#include "reports/pages/html_page.h"
#include "reports/pictures/pictures.h"
#include "reports/pictures/side_by_side.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kFiguresMark = "README";

std::vector<RunPictures> AllPictures(const ReportedExperiment& experiment) {
  std::vector<RunPictures> pictures = MakeSideBySide(experiment);
  for (RunPictures& run : MakePictures(experiment)) pictures.push_back(std::move(run));
  return pictures;
}

void WritePictureSheets(const DrawingWriter& writer, const std::vector<RunPictures>& pictures,
                        const SheetStyle& style, const fs::path& folder) {
  for (const RunPictures& run : pictures) {
    if (run.strips.empty()) continue;
    WritePictureSheet(writer, folder / ("pictures-" + run.run_id), run, style);
  }
}

// The figure as LaTeX takes it, with its caption.
std::string LatexFigure(const Figure& figure) {
  return fmt::format(
      "\\begin{{figure}}[t]\n  \\centering\n  \\includegraphics{{{0}}}\n  \\caption{{{1}. {2}}}\n  "
      "\\label{{fig:{0}}}\n\\end{{figure}}\n",
      figure.name, LatexEscaped(figure.title), LatexEscaped(figure.caption));
}

// For whoever writes the caption: what the figure shows, and the runs behind each name in it.
std::string CaptionFile(const Figure& figure) {
  std::string text = figure.title + "\n\n" + figure.caption + "\n";
  for (const auto& [name, ids] : figure.runs)
    text += fmt::format("\n{}\n  {}\n", name, fmt::join(ids, "\n  "));
  return text;
}

DrawingWriter WriterFor(const PaperFormat& format) {
  constexpr double kDotsPerInch = 300.0, kPointsPerInch = 72.0;
  return DrawingWriter({1.0, kDotsPerInch / kPointsPerInch, format.formats});
}

}  // namespace

fs::path WritePaperFigures(const fs::path& experiment_folder, const PaperFormat& format) {
  const ReportedExperiment experiment = ReadExperiment(experiment_folder);
  const DrawingWriter writer = WriterFor(format);
  const FigureStyle style{format.width_pt, format.text_pt};
  StagedFolder folder(experiment_folder / "paper", kFiguresMark);
  WriteWholeFile(folder.path() / kFiguresMark,
                 fmt::format("Drawn by vitruvia report: {:.1f} mm wide, text of {:g} pt.\n",
                             format.width_pt / kPointsPerMillimeter, format.text_pt));
  for (const Figure& figure : MakeFigures(experiment)) {
    writer.Write(folder.path() / figure.name, style.width, FigureHeight(figure, style),
                 [&](Canvas& canvas) { DrawFigure(canvas, figure, style); });
    WriteWholeFile(folder.path() / (figure.name + ".txt"), CaptionFile(figure));
    WriteWholeFile(folder.path() / (figure.name + ".tex"), LatexFigure(figure));
  }
  WritePictureSheets(writer, AllPictures(experiment), {format.text_pt, format.width_pt},
                     folder.path());
  folder.Commit();
  return experiment_folder / "paper";
}

fs::path WriteReport(const fs::path& experiment_folder) {
  const ReportedExperiment experiment = ReadExperiment(experiment_folder);

  StagedFolder figures_folder(experiment_folder / "figures", kFiguresMark);
  WriteWholeFile(figures_folder.path() / kFiguresMark,
                 "Drawn by vitruvia; drawn anew with each report.\n");
  const std::vector<DrawnFigure> figures =
      DrawFigures(MakeFigures(experiment), figures_folder.path());
  const std::vector<RunPictures> pictures = AllPictures(experiment);
  WritePictureSheets(DrawingWriter(), pictures, {}, figures_folder.path());
  figures_folder.Commit();

  WriteWholeFile(experiment_folder / "table.csv", ToCsv(experiment));
  WriteWholeFile(experiment_folder / "table.tex", ToLatex(experiment));
  WriteWholeFile(experiment_folder / "table.md", ToMarkdown(experiment));
  const fs::path page = experiment_folder / "report.html";
  WriteWholeFile(page, MakePage(experiment, figures, pictures));
  return page;
}

}  // namespace vitruvia
