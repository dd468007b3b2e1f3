#include "reports/pages/report.h"

#include "analysis/tables.h"
#include "analysis/text_table.h"
#include "core/files.h"
#include "reports/figures/figure_parts.h"
#include "reports/figures/run_plots.h"
#include "reports/pages/html_page.h"
#include "reports/pictures/cause_pictures.h"
#include "reports/pictures/drawn_before.h"
#include "reports/pictures/pictures.h"
#include "reports/pictures/side_by_side.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kFiguresMark = "README";

// Draws pictures and writes their sheets. What is returned holds them encoded only.
std::vector<RunPictures> WritePictureSheets(const ReportedExperiment& experiment,
                                            const DrawnBefore& before, const PictureUse& write) {
  const auto write_sheet = [&](RunPictures& run) {
    if (run.strips.empty()) return;
    write(run);
    for (PictureStrip& strip : run.strips) {
      for (Picture& picture : strip.pictures) picture.image = {};
    }
  };
  std::vector<RunPictures> pictures = MakeSideBySide(experiment, before, write_sheet);
  for (RunPictures& run : MakePictures(experiment, before, write_sheet))
    pictures.push_back(std::move(run));
  return pictures;
}

// The sheets of pictures that were not drawn anew.
void TakeOverSheets(const std::vector<RunPictures>& pictures, const fs::path& from,
                    const fs::path& to) {
  for (const RunPictures& run : pictures) {
    for (const char* ending : {".svg", ".png"}) {
      const fs::path file = SheetStem(to, run.run_id).concat(ending);
      if (!run.strips.empty() && !fs::exists(file))
        fs::copy_file(SheetStem(from, run.run_id).concat(ending), file);
    }
  }
}

// The figure as LaTeX takes it, with its caption.
std::string LatexFigure(const Figure& figure) {
  return fmt::format(
      "\\begin{{figure}}[t]\n  \\centering\n  \\includegraphics{{{0}}}\n  \\caption{{{1}. {2}}}\n  "
      "\\label{{fig:{0}}}\n\\end{{figure}}\n",
      figure.name, LatexEscaped(figure.title), LatexEscaped(figure.caption));
}

// For the author of the caption: what the figure shows, and the runs behind each name in it.
std::string CaptionFile(const Figure& figure) {
  std::string text = figure.title + "\n\n" + figure.caption + "\n";
  for (const auto& [name, ids] : figure.runs)
    text += fmt::format("\n{}\n  {}\n", name, fmt::join(ids, "\n  "));
  return text;
}

void WriteCaption(const Figure& figure, const fs::path& folder) {
  WriteWholeFile(folder / (figure.name + ".txt"), CaptionFile(figure));
  WriteWholeFile(folder / (figure.name + ".tex"), LatexFigure(figure));
}

// A sheet of pictures as a figure with a caption; its name is one that LaTeX takes.
Figure SheetFigure(const RunPictures& run) {
  std::vector<std::string> rows;
  for (const PictureStrip& strip : run.strips) rows.push_back(strip.label);
  Figure figure;
  figure.name = "pictures-" + FileSafe(run.run_id);
  figure.title = "Pictures";
  figure.caption =
      fmt::format("Rows: {}. Columns: {}.", fmt::join(rows, "; "), fmt::join(run.titles, "; "));
  figure.runs = {{"all pictures", {run.run_id}}};
  return figure;
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
    WriteCaption(figure, folder.path());
  }
  WritePictureSheets(experiment, {}, [&](const RunPictures& run) {
    const Figure figure = SheetFigure(run);
    WritePictureSheet(writer, folder.path() / figure.name, run, {format.text_pt, format.width_pt});
    WriteCaption(figure, folder.path());
  });
  folder.Commit();
  return experiment_folder / "paper";
}

fs::path WriteReport(const fs::path& experiment_folder) {
  const ReportedExperiment experiment = ReadExperiment(experiment_folder);

  const fs::path figures_folder = experiment_folder / "figures";
  const DrawnBefore before(experiment, figures_folder);
  StagedFolder staged(figures_folder, kFiguresMark);
  WriteWholeFile(staged.path() / kFiguresMark, "Drawn by vitruvia; written by each report.\n");
  const std::vector<DrawnFigure> figures = DrawFigures(MakeFigures(experiment), staged.path());
  const DrawingWriter sheet_writer({.png_scale = kSheetPngScale});
  const std::vector<RunPictures> pictures =
      WritePictureSheets(experiment, before, [&](const RunPictures& run) {
        WritePictureSheet(sheet_writer, SheetStem(staged.path(), run.run_id), run, {});
      });
  TakeOverSheets(pictures, figures_folder, staged.path());
  const std::vector<RunCauses> causes = FindCauses(experiment, before);
  before.Keep(pictures, causes, staged.path());
  staged.Commit();

  WriteWholeFile(experiment_folder / "table.csv", ToCsv(experiment));
  WriteWholeFile(experiment_folder / "table.tex", ToLatex(experiment));
  WriteWholeFile(experiment_folder / "table.md", ToMarkdown(experiment));
  const fs::path page = experiment_folder / "report.html";
  WriteWholeFile(page, MakePage(experiment, figures, causes, pictures));
  return page;
}

}  // namespace vitruvia
