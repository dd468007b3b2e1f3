#include "reports/pages/reproduction_page.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "analysis/printed_metric.h"
#include "core/files.h"
#include "core/pattern.h"
#include "records/bone_tree.h"
#include "reports/drawing/html_text.h"
#include "reports/figures/contender_plots.h"
#include "reports/figures/run_plots.h"
#include "reports/figures/tree_drawing.h"
#include "reports/pages/page_parts.h"
#include "reports/pages/picture_section.h"
#include "reports/pictures/drawn_before.h"
#include "reports/pictures/pictures.h"
#include "reports/pictures/side_by_side.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kPlotsMark = "README";

std::string VerdictClass(ClaimVerdict verdict) {
  switch (verdict) {
    case ClaimVerdict::kHolds:
      return "verdict met";
    case ClaimVerdict::kDoesNotHold:
      return "verdict missed";
    case ClaimVerdict::kCannotBeTested:
      break;
  }
  return "soft";
}

std::string VerdictHtml(ClaimVerdict verdict, const std::string& reason) {
  return fmt::format("<b class=\"{}\">{}</b>{}", VerdictClass(verdict), Name(verdict),
                     reason.empty() ? "" : ": " + Escaped(reason));
}

// Verdict of a figure; for a figure without a claim, only what is missing.
std::string OutcomeHtml(const ReproducedFigure& figure, const ClaimDecision& decision) {
  if (!figure.claim.empty()) return VerdictHtml(decision.verdict, decision.reason);
  return decision.reason.empty()
             ? ""
             : fmt::format("<span class=\"soft\">{}</span>", Escaped(decision.reason));
}

std::string Overview(const std::vector<FigureRecords>& figures,
                     const std::vector<ClaimDecision>& decisions) {
  std::string rows;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const ReproducedFigure& figure = figures[i].figure;
    rows += fmt::format(
        "<tr><td><a href=\"#{0}\">{0}</a></td><td>{1}</td><td>{2}</td><td>{3}</td></tr>\n",
        Escaped(figure.id), Escaped(figure.title), Escaped(figure.claim),
        OutcomeHtml(figure, decisions[i]));
  }
  return "<section id=\"overview\"><h2>All claims</h2>\n<div class=\"scroll\"><table><thead><tr>"
         "<th>figure</th><th>about</th><th>claim</th><th>verdict</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div></section>\n";
}

std::string Header(const ReproductionList& list, const std::vector<FigureRecords>& figures,
                   const std::vector<ClaimDecision>& decisions) {
  const auto count = [&](ClaimVerdict verdict) {
    int figures_with_it = 0;
    for (std::size_t i = 0; i < figures.size(); ++i) {
      const bool has_claim = !figures[i].figure.claim.empty();
      figures_with_it += has_claim && decisions[i].verdict == verdict ? 1 : 0;
    }
    return figures_with_it;
  };
  const int held = count(ClaimVerdict::kHolds), refuted = count(ClaimVerdict::kDoesNotHold);
  const int untested = count(ClaimVerdict::kCannotBeTested);
  return fmt::format(
      "<header><h1>{}</h1><p>{}</p><p>Of {} figures and tables the claim <b "
      "class=\"met\">holds</b> "
      "in {}, <b class=\"missed\">does not hold here</b> in {} and cannot be tested here in "
      "{}.</p></header>\n",
      Escaped(list.title), Escaped(list.description), held + refuted + untested, held, refuted,
      untested);
}

std::string TestsTable(const ReproducedFigure& figure, const ClaimDecision& decision) {
  if (decision.findings.empty()) return "";
  std::string rows;
  for (std::size_t i = 0; i < decision.findings.size(); ++i) {
    const ClaimFinding& finding = decision.findings[i];
    const std::string& remark = figure.tests[i].remark;
    rows += fmt::format(
        "<tr><td>{}{}</td><td class=\"n\">{}</td><td>{}</td><td>{}</td></tr>\n",
        Escaped(finding.statement),
        remark.empty() ? "" : fmt::format("<br><small class=\"soft\">{}</small>", Escaped(remark)),
        Escaped(finding.published), Escaped(finding.ours),
        VerdictHtml(finding.verdict, finding.reason));
  }
  return "<div class=\"scroll\"><table><thead><tr><th>test</th><th class=\"n\">published</th>"
         "<th>ours</th><th>verdict</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div>\n";
}

// Leaves out the pictures whose titles match no pattern, and the scale of errors with the last of
// them that shows any.
void KeepPanels(const std::vector<std::string>& patterns, RunPictures& run) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < run.titles.size(); ++i) {
    if (MatchesAny(patterns, run.titles[i])) kept.push_back(i);
  }
  const auto keep = [&kept](auto& items) {
    std::remove_reference_t<decltype(items)> chosen;
    for (const std::size_t i : kept) chosen.push_back(std::move(items[i]));
    items = std::move(chosen);
  };
  for (PictureStrip& strip : run.strips) keep(strip.pictures);
  keep(run.titles);
  const bool shows_errors =
      std::any_of(run.titles.begin(), run.titles.end(),
                  [](const std::string& title) { return title.starts_with("error"); });
  if (!shows_errors) run.error_scale_m = 0.0;
}

std::vector<RunPictures> PicturesOf(const ReportedExperiment& experiment,
                                    const ShownPictures& shown) {
  ReportedExperiment chosen = RunsThatMatch(experiment, shown.of, shown.scenes);
  std::erase_if(chosen.runs, [&shown](const ReportedRun& run) {
    const std::vector<int>& seeds = shown.seeds;
    return !seeds.empty() && std::find(seeds.begin(), seeds.end(), run.record->seed) == seeds.end();
  });
  if (chosen.runs.empty()) return {};
  if (!shown.frames.empty()) chosen.record.picture_frames = shown.frames;
  chosen.record.side_by_side = shown.side_by_side;
  std::vector<RunPictures> pictures =
      shown.side_by_side ? MakeSideBySide(chosen, {}) : MakePictures(chosen, {});
  for (RunPictures& run : pictures) KeepPanels(shown.panels, run);
  return pictures;
}

std::string PicturesHtml(const FigureRecords& records) {
  std::string html;
  for (const ShownPictures& shown : records.figure.pictures) {
    for (const ReportedExperiment& experiment : records.experiments) {
      for (const RunPictures& run : PicturesOf(experiment, shown)) {
        html +=
            fmt::format("<h3 class=\"run\">{}</h3>\n", Escaped(run.run_id)) + RunPicturesHtml(run);
      }
    }
  }
  return html;
}

bool IsChosen(const Figure& plot, const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(),
                     [&plot](const std::string& name) { return plot.name.starts_with(name); });
}

// Whether the figure is about methods over all of their variants, as its tables are.
bool IsOverVariants(const ReproducedFigure& figure) {
  return std::any_of(figure.tables.begin(), figure.tables.end(),
                     [](const ShownTable& table) { return table.rows == TableRows::kMethods; });
}

std::vector<Figure> AllPlots(const ReportedExperiment& experiment) {
  std::vector<Figure> all = MakeFigures(experiment);
  for (Figure& plot : MakeContenderPlots(experiment)) all.push_back(std::move(plot));
  return all;
}

ReportedExperiment OverVariants(ReportedExperiment experiment) {
  for (ReportedRun& run : experiment.runs) {
    if (run.record) run.record->variant.clear();
  }
  return experiment;
}

std::vector<Figure> PlotsOf(const FigureRecords& records) {
  std::vector<Figure> plots;
  if (records.figure.plots.empty()) return plots;
  for (std::size_t e = 0; e < records.experiments.size(); ++e) {
    std::vector<Figure> all = IsOverVariants(records.figure)
                                  ? AllPlots(OverVariants(records.experiments[e]))
                                  : AllPlots(records.experiments[e]);
    for (Figure& plot : all) {
      if (!IsChosen(plot, records.figure.plots)) continue;
      plot.name = fmt::format("{}-{}-{}", records.figure.id, e + 1, plot.name);
      plots.push_back(std::move(plot));
    }
  }
  return plots;
}

std::vector<DrawnFigure> DrawTrees(const FigureRecords& records, const fs::path& folder) {
  const DrawingWriter writer;
  std::vector<DrawnFigure> drawn;
  for (const ReportedExperiment& experiment : records.experiments) {
    for (const RunRecord* run : experiment.finished()) {
      if (!HasBoneTree(experiment.folder / run->run_id)) continue;
      const BoneTree tree = ReadBoneTree(experiment.folder / run->run_id);
      const TreeSize size = SizeOf(tree);
      const fs::path stem = folder / fmt::format("{}-{}-tree", records.figure.id, drawn.size() + 1);
      writer.Write(stem, size.width, size.height,
                   [&tree](Canvas& canvas) { DrawTree(canvas, tree); });
      drawn.push_back(
          {stem.filename().string(), tree.title, "", ReadWholeFile(fs::path(stem).concat(".svg"))});
    }
  }
  return drawn;
}

std::string TableHtml(const ShownTable& table, const std::vector<ReportedExperiment>& experiments) {
  std::string head = fmt::format("<th>{}</th><th class=\"n\">runs</th>",
                                 table.rows == TableRows::kMethods ? "method" : "method/variant");
  std::string rows;
  for (const std::string& key : table.metrics)
    head += fmt::format("<th class=\"n\">{}</th>", Escaped(Titled(FindMetric(key))));
  for (const TableRow& row : Tabulate(table, experiments)) {
    rows += fmt::format("<tr><td class=\"run\">{}</td><td class=\"n\">{}</td>", Escaped(row.name),
                        row.runs);
    for (std::size_t m = 0; m < row.means.size(); ++m) {
      const Metric metric = FindMetric(table.metrics[m]);
      rows += fmt::format("<td class=\"n\">{}</td>",
                          std::isnan(row.means[m]) ? kNoNumber : Printed(row.means[m], metric));
    }
    rows += "</tr>\n";
  }
  if (rows.empty()) return "";
  return fmt::format(
      "<h3>{}</h3><div class=\"scroll\"><table "
      "class=\"variants\"><thead><tr>{}</tr></thead><tbody>\n"
      "{}</tbody></table></div>\n",
      Escaped(table.title), head, rows);
}

// Which of the two sets a figure of Stanford EVAL is made from; "" of other figures.
std::string EvalNote(const ReproducedFigure& figure) {
  if (figure.eval_experiments.empty()) return "";
  return fmt::format("<p class=\"soft\">{}</p>\n",
                     figure.experiments == figure.eval_experiments
                         ? "Made from your own sequences of Stanford EVAL."
                         : "Made from the synthetic set in the spirit of Stanford EVAL; your own "
                           "sequences take its "
                           "place where VITRUVIA_EVAL names their folder.");
}

// What of the experiments was left out, and where the numbers come from.
std::string Origins(const ReproductionList& list, const FigureRecords& records) {
  std::string html = EvalNote(records.figure);
  for (const fs::path& file : records.figure.experiments) {
    const ExperimentReduction* reduction = list.ReductionOf(file);
    if (reduction == nullptr) continue;
    html += fmt::format("<p class=\"soft\">A part of {}: {}</p>\n", Escaped(file.stem().string()),
                        Escaped(reduction->why));
  }
  std::string runs;
  std::set<std::string> builds;
  for (const ReportedExperiment& experiment : records.experiments) {
    for (const ReportedRun& run : experiment.runs) {
      runs += fmt::format("<br>{}/{}", Escaped(experiment.record.name), Escaped(run.run_id));
      if (run.record) builds.insert(run.record->provenance.value("commit", ""));
    }
  }
  if (runs.empty()) return html;
  return html + fmt::format(
                    "<details><summary>Runs, of build {}</summary><p class=\"run\">{}</p>"
                    "</details>\n",
                    Escaped(fmt::format("{}", fmt::join(builds, ", "))), runs);
}

std::string FigureSection(const ReproductionList& list, const FigureRecords& records,
                          const ClaimDecision& decision, const fs::path& plots_folder) {
  const ReproducedFigure& figure = records.figure;
  std::string html =
      fmt::format("<section id=\"{}\"><h2>{}: {}</h2>\n<p>{}</p>\n", Escaped(figure.id),
                  Escaped(figure.place), Escaped(figure.title), Escaped(figure.caption));
  if (figure.claim.empty()) {
    html += fmt::format("<p>{}</p>\n", OutcomeHtml(figure, decision));
  } else {
    html += fmt::format(
        "<dl><dt>published</dt><dd>{}</dd><dt>claim</dt><dd>{}</dd><dt>verdict</dt><dd>{}</dd>"
        "</dl>\n",
        Escaped(figure.published), Escaped(figure.claim), OutcomeHtml(figure, decision));
  }
  html += TestsTable(figure, decision);
  for (const ShownTable& table : figure.tables) html += TableHtml(table, records.experiments);
  html += PicturesHtml(records);
  for (const DrawnFigure& tree : DrawTrees(records, plots_folder)) html += FigureHtml(tree);
  for (const DrawnFigure& plot : DrawFigures(PlotsOf(records), plots_folder))
    html += FigureHtml(plot);
  return html + Origins(list, records) + "</section>\n";
}

}  // namespace

void WriteReproductionPage(const ReproductionList& list, const std::vector<FigureRecords>& figures,
                           const fs::path& page) {
  std::vector<ClaimDecision> decisions;
  for (const FigureRecords& records : figures) decisions.push_back(DecideFigure(records));
  std::string body = Header(list, figures, decisions) + "<main>\n" + Overview(figures, decisions);

  MakeFolder(page.parent_path());
  StagedFolder plots_folder(fs::path(page).replace_extension(), kPlotsMark);
  WriteWholeFile(plots_folder.path() / kPlotsMark,
                 "Drawn by vitruvia; drawn anew with each page.\n");
  for (std::size_t i = 0; i < figures.size(); ++i)
    body += FigureSection(list, figures[i], decisions[i], plots_folder.path());
  plots_folder.Commit();
  WriteWholeFile(page, PageOf(list.title, body + "</main>\n"));
}

}  // namespace vitruvia
