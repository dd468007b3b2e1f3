#include "reports/pages/html_page.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "analysis/tables.h"
#include "analysis/variant_comparison.h"
#include "reports/drawing/html_text.h"
#include "reports/pages/cause_section.h"
#include "reports/pages/comparison_section.h"
#include "reports/pages/picture_section.h"
#include "reports/pages/viewer_link.h"

namespace vitruvia {
namespace {

std::string VerdictCell(Verdict verdict) {
  switch (verdict) {
    case Verdict::kMet:
      return "<td class=\"verdict met\">✓ met</td>";
    case Verdict::kMissed:
      return "<td class=\"verdict missed\">✗ missed</td>";
    case Verdict::kNoResult:
      return "<td class=\"verdict none\">no result</td>";
    case Verdict::kNotComparable:
      return "<td class=\"verdict soft\">not comparable</td>";
    case Verdict::kNoTarget:
      break;
  }
  return "<td></td>";
}

bool HasFrames(const RunRecord* run) { return !run->frames.empty(); }

// Missing truth and warnings, each different text once, because runs of one sequence share them.
std::string CaveatsText(const std::vector<const RunRecord*>& runs) {
  std::string html;
  std::set<std::string> told;
  const auto add = [&](const char* kind, const RunRecord& run, const std::string& text) {
    const std::string line =
        fmt::format("<p><b>{}</b> · {}</p>", kind, Escaped(fmt::format("{}: {}", run.scene, text)));
    if (told.insert(line).second) html += line;
  };
  for (const RunRecord* run : runs) {
    const auto found = run->summary.find("not_scored");
    if (found != run->summary.end() && found->is_string())
      add("Not scored", *run, found->get<std::string>());
    for (const std::string& warning : run->warnings) add("Warning", *run, warning);
  }
  return html;
}

std::string Header(const ReportedExperiment& experiment) {
  const std::size_t finished = experiment.finished().size();
  const std::size_t absent = experiment.runs.size() - finished;
  const auto runs = experiment.finished();
  const bool tracked = runs.empty() || std::any_of(runs.begin(), runs.end(), HasFrames);
  std::string status = fmt::format("{} of {} runs finished", finished, experiment.runs.size());
  if (absent > 0) status += fmt::format("; <b>{} failed or missing</b>, listed below", absent);
  return fmt::format(
      "<header><p class=\"kicker\"><code>{}</code></p><h1>{}</h1><p>{}</p>"
      "<p class=\"soft\">{}.</p>{}"
      "<nav>{}<a href=\"#papers\">Paper and ours</a>{}<a href=\"#pictures\">Pictures</a>{}"
      "<a href=\"#runs\">All runs</a><a href=\"#provenance\">Provenance</a></nav></header>\n",
      Escaped(experiment.record.name), Escaped(experiment.record.title),
      Escaped(experiment.record.description), status, CaveatsText(runs),
      ContendersOf(experiment).size() < 2 ? "" : "<a href=\"#summary\">Variants</a>",
      tracked ? "<a href=\"#plots\">Plots</a><a href=\"#causes\">Causes</a>" : "",
      tracked ? "<a href=\"#steps\">Time per step</a>" : "");
}

std::string ComparisonRows(const Comparison& c) {
  std::string rows = fmt::format(
      "<tbody><tr class=\"group\"><th colspan=\"6\" scope=\"rowgroup\">{} <span class=\"soft\">· "
      "{}</span><small>{}</small></th></tr>\n",
      Escaped(Titled(c.metric)), Escaped(c.expectation.source),
      Escaped(c.expectation.not_comparable.empty()
                  ? c.expectation.remark
                  : "Not comparable: " + c.expectation.not_comparable));
  for (const ComparedRun& run : c.runs) {
    rows += fmt::format("<tr><td class=\"run\">{}</td><td class=\"n\" data-label=\"paper\">{}</td>",
                        Escaped(run.run_id), c.paper);
    rows += run.problem.empty()
                ? fmt::format(
                      "<td class=\"n\" data-label=\"ours\">{}</td><td class=\"n\" "
                      "data-label=\"difference\">{}</td>",
                      run.ours, run.difference)
                : fmt::format("<td class=\"problem\" colspan=\"2\">{}</td>", Escaped(run.problem));
    rows += fmt::format("<td class=\"n\" data-label=\"target\">{}</td>{}</tr>\n",
                        c.target.empty() ? "–" : (c.more_is_better() ? "≥ " : "≤ ") + c.target,
                        VerdictCell(run.verdict));
  }
  return rows + "</tbody>\n";
}

std::string PaperSection(const ReportedExperiment& experiment) {
  std::string html = "<section id=\"papers\"><h2>Paper and ours</h2>\n";
  if (experiment.record.expectations.empty()) {
    return html + "<p>No paper gives numbers for this experiment.</p></section>\n";
  }
  html +=
      "<p>The difference is ours minus the paper’s. The remark under each number says how our work "
      "differs from the paper’s.</p><div class=\"scroll\"><table "
      "class=\"compare\"><thead><tr><th>run</th>"
      "<th class=\"n\">paper</th><th class=\"n\">ours</th><th class=\"n\">difference</th>"
      "<th class=\"n\">target</th><th></th></tr></thead>\n";
  for (const Comparison& c : CompareWithPapers(experiment)) html += ComparisonRows(c);
  return html + "</table></div></section>\n";
}

std::string PlotSection(const ReportedExperiment& experiment,
                        const std::vector<DrawnFigure>& figures) {
  const bool finished = !experiment.finished().empty();
  if (finished && figures.empty()) return "";  // runs without frames
  std::string html = "<section id=\"plots\"><h2>Plots</h2>\n";
  if (!finished) html += "<p>No run has finished, so there is nothing to plot.</p>\n";
  for (const DrawnFigure& figure : figures) html += FigureHtml(figure);
  return html + "</section>\n";
}

std::string StepRows(const RunRecord& run) {
  const auto number = [](double ms) {
    return std::isnan(ms) ? std::string("–") : fmt::format("{:.2f}", ms);
  };
  std::string rows;
  const std::vector<StepRow> steps = CompareSteps(run);
  for (const StepRow& step : steps) {
    const bool total = &step == &steps.back();
    rows += fmt::format(
        "<tr{}><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>"
        "<td class=\"n\">{}</td><td class=\"n\">{}</td></tr>\n",
        total ? " class=\"total\"" : "", Escaped(step.name), number(step.paper_per_iteration_ms),
        number(step.paper_per_frame_ms), number(step.median_ms), number(step.p95_ms),
        number(step.max_ms));
  }
  return rows;
}

std::string StepSection(const ReportedExperiment& experiment) {
  const auto runs = experiment.finished();
  if (!runs.empty() && std::none_of(runs.begin(), runs.end(), HasFrames)) return "";
  std::string html =
      "<section id=\"steps\"><h2>Time per step</h2>\n<p>Milliseconds. Ours are per frame, summed "
      "over the frame’s iterations. Paper A’s table 1 was measured on one 3.4 GHz CPU; its steps 5 "
      "to 11 are printed per iteration and stand here times its 3.5 iterations a frame.</p>\n";
  bool first = true;
  for (const RunRecord* run : runs) {
    html += fmt::format(
        "<details{}><summary class=\"run\">{}</summary><div class=\"scroll\"><table><thead><tr>"
        "<th>step</th><th class=\"n\">paper, per iteration</th><th class=\"n\">paper, per "
        "frame</th>"
        "<th class=\"n\">ours, median</th><th class=\"n\">ours, 95th percentile</th>"
        "<th class=\"n\">ours, "
        "maximum</th></tr></thead><tbody>\n{}</tbody></table></div></details>\n",
        first ? " open" : "", Escaped(run->run_id), StepRows(*run));
    first = false;
  }
  return html + "</section>\n";
}

std::string SummaryCell(const nlohmann::json& cell, const Metric& column) {
  const std::string value = cell.is_string() ? cell.get<std::string>() : cell.dump();
  return fmt::format("<td class=\"{}\"{}>{}</td>", cell.is_string() ? "" : "n",
                     cell.is_null() ? "" : fmt::format(" data-value=\"{}\"", Escaped(value)),
                     Escaped(PrintedCell(cell, column)));
}

std::string RunIdCell(const std::string& run_id, const ReportedExperiment& experiment) {
  return fmt::format(
      "<td class=\"run\" data-value=\"{}\">{}</td>", Escaped(run_id),
      RunWithViewer(run_id, ViewerLink(experiment.folder, run_id, experiment.folder)));
}

bool HasViewers(const ReportedExperiment& experiment) {
  return std::ranges::any_of(experiment.runs, [&](const ReportedRun& run) {
    return !ViewerLink(experiment.folder, run.run_id, experiment.folder).empty();
  });
}

std::string RunsSection(const ReportedExperiment& experiment) {
  const SummaryTable table = MakeSummaryTable(experiment);
  std::string html =
      "<section id=\"runs\"><h2>All runs</h2><p class=\"soft\">A click on a column’s name sorts by "
      "it.</p>\n" +
      ViewerChoice(HasViewers(experiment), experiment.record.name) +
      "<div class=\"scroll\"><table class=\"sortable\"><thead><tr>";
  for (const Metric& column : table.columns) {
    html += fmt::format("<th><button type=\"button\">{}</button></th>", Escaped(Titled(column)));
  }
  html += "</tr></thead><tbody>\n";
  for (const SummaryTable::Row& row : table.rows) {
    html += "<tr>";
    if (row.problem.empty()) {
      for (std::size_t i = 0; i < row.cells.size(); ++i) {
        html += table.columns[i].key == "run_id"
                    ? RunIdCell(row.cells[i].get<std::string>(), experiment)
                    : SummaryCell(row.cells[i], table.columns[i]);
      }
    } else {
      html += RunIdCell(row.cells.front().get<std::string>(), experiment) +
              fmt::format("<td class=\"problem\" colspan=\"{}\">{}</td>", row.cells.size() - 1,
                          Escaped(row.problem));
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div></section>\n";
}

std::string ProvenanceOf(const RunRecord& run) {
  std::string items;
  const auto add = [&](const std::string& key, const nlohmann::json& value) {
    items += fmt::format("<dt>{}</dt><dd>{}</dd>", Escaped(key),
                         Escaped(value.is_string() ? value.get<std::string>() : value.dump()));
  };
  add("method", run.method);
  add("scene", run.scene);
  add("variant", run.variant);
  add("seed", run.seed);
  add("sequence", run.sequence_folder.generic_string());
  add("sequence hash", run.sequence_hash);
  if (!std::isnan(run.diagonal_m)) add("diagonal", fmt::format("{:.4f} m", run.diagonal_m));
  for (const auto& item : run.provenance.items()) add(item.key(), item.value());
  return fmt::format(
      "<details><summary class=\"run\">{}</summary><dl>{}</dl><details><summary>resolved "
      "configuration</summary><pre>{}</pre></details></details>\n",
      Escaped(run.run_id), items, Escaped(run.config.dump(2)));
}

std::string ProvenanceSection(const ReportedExperiment& experiment) {
  std::string html = "<section id=\"provenance\"><h2>Provenance</h2>\n";
  for (const RunRecord* run : experiment.finished()) html += ProvenanceOf(*run);
  return html + "</section>\n";
}

}  // namespace

std::string MakePage(const ReportedExperiment& experiment, const std::vector<DrawnFigure>& figures,
                     const std::vector<RunCauses>& causes,
                     const std::vector<RunPictures>& pictures) {
  return PageOf(experiment.record.title,
                Header(experiment) + "<main>\n" + VariantSection(experiment) +
                    PaperSection(experiment) + ComparisonSection(experiment) +
                    PlotSection(experiment, figures) + CauseSection(experiment, causes) +
                    PictureSection(pictures) + StepSection(experiment) + RunsSection(experiment) +
                    ProvenanceSection(experiment) + "</main>\n");
}

}  // namespace vitruvia
