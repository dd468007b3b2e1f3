#include "reports/pages/index_page.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "analysis/tables.h"
#include "records/metric_value.h"
#include "reports/drawing/html_text.h"
#include "reports/pages/viewer_link.h"

namespace vitruvia {
namespace {

std::string LinkTo(const IndexedExperiment& indexed, const std::string& text) {
  if (indexed.link.empty()) return Escaped(text);
  return fmt::format("<a href=\"{}\">{}</a>", Escaped(indexed.link), Escaped(text));
}

std::string TableHead(const char* classes, const std::vector<std::string>& columns) {
  std::string html = fmt::format("<div class=\"scroll\"><table class=\"{}\"><thead><tr>", classes);
  for (const std::string& column : columns)
    html += fmt::format("<th><button type=\"button\">{}</button></th>", Escaped(column));
  return html + "</tr></thead><tbody>\n";
}

std::string TextCell(const std::string& html, const std::string& value) {
  return fmt::format("<td data-value=\"{}\">{}</td>", Escaped(value), html);
}

// Ours over all runs of an experiment that a published number is about.
struct OursInAll {
  double least = NAN, most = NAN;
  int runs = 0, met = 0;  // without a result none is met
};

OursInAll OursOf(const ReportedExperiment& experiment, const Comparison& comparison) {
  OursInAll ours;
  for (const ComparedRun& run : comparison.runs) {
    ++ours.runs;
    ours.met += run.verdict == Verdict::kMet ? 1 : 0;
  }
  for (const RunRecord* run : experiment.finished()) {
    const double value = MetricValue(*run, comparison.metric);
    if (std::isnan(value) || !comparison.expectation.IsAbout(run->scene)) continue;
    ours.least = std::isnan(ours.least) ? value : std::min(ours.least, value);
    ours.most = std::isnan(ours.most) ? value : std::max(ours.most, value);
  }
  return ours;
}

std::string OursText(const OursInAll& ours, const Metric& metric) {
  if (std::isnan(ours.least)) return "–";
  const std::string least = Printed(ours.least, metric), most = Printed(ours.most, metric);
  return least == most ? least : fmt::format("{} … {}", least, most);
}

// Sorted by data-value: targets met, no target, no result, targets missed.
std::string VerdictOfAll(const OursInAll& ours, const Comparison& comparison) {
  const std::string& why_not = comparison.expectation.not_comparable;
  if (!why_not.empty()) {
    return fmt::format("<td class=\"soft\" data-value=\"3\">not comparable because {}</td>",
                       Escaped(why_not));
  }
  if (std::isnan(ours.least)) return "<td class=\"verdict none\" data-value=\"2\">no result</td>";
  if (comparison.target.empty()) return "<td class=\"soft\" data-value=\"1\">no target</td>";
  if (ours.met == ours.runs) return "<td class=\"verdict met\" data-value=\"0\">✓ met</td>";
  return fmt::format("<td class=\"verdict missed\" data-value=\"4\">✗ {} of {} met</td>", ours.met,
                     ours.runs);
}

std::string TargetText(const Comparison& comparison) {
  if (comparison.target.empty()) return "–";
  return (comparison.more_is_better() ? "≥ " : "≤ ") + comparison.target;
}

std::string PaperRow(const IndexedExperiment& indexed, const Comparison& comparison) {
  const Expectation& e = comparison.expectation;
  const OursInAll ours = OursOf(indexed.experiment, comparison);
  const auto number_cell = [&](const char* label, const std::string& text, double value) {
    return fmt::format("<td class=\"n\" data-label=\"{}\"{}>{}</td>", label,
                       std::isnan(value) ? "" : fmt::format(" data-value=\"{}\"", value), text);
  };
  return "<tr>" + TextCell(Escaped(e.source), e.source) +
         TextCell(Escaped(Titled(comparison.metric)), Titled(comparison.metric)) +
         number_cell("published", comparison.paper, e.paper) +
         number_cell("ours", OursText(ours, comparison.metric), ours.most) +
         number_cell("target", TargetText(comparison),
                     comparison.more_is_better() ? e.at_least : e.at_most) +
         VerdictOfAll(ours, comparison) +
         TextCell(LinkTo(indexed, indexed.experiment.record.name), indexed.experiment.record.name) +
         fmt::format("<td class=\"soft\">{}</td></tr>\n", Escaped(e.remark));
}

std::string PaperSectionOfAll(const IndexContent& content) {
  std::string rows;
  for (const IndexedExperiment& indexed : content.experiments) {
    for (const Comparison& comparison : CompareWithPapers(indexed.experiment))
      rows += PaperRow(indexed, comparison);
  }
  if (rows.empty()) return "";
  return "<section id=\"papers\"><h2>The papers’ figures and tables</h2>\n<p>Published value, ours "
         "over all runs of the experiment, the target and the verdict.</p>" +
         TableHead("sortable papers", {"figure or table", "number", "published", "ours", "target",
                                       "verdict", "experiment", "how the work differs"}) +
         rows + "</tbody></table></div></section>\n";
}

std::string ExperimentCard(const IndexedExperiment& indexed) {
  const ReportedExperiment& experiment = indexed.experiment;
  const std::size_t finished = experiment.finished().size();
  const std::size_t absent = experiment.runs.size() - finished;
  std::string html = fmt::format(
      "<article class=\"card\"><h3>{}</h3><p class=\"kicker\"><code>{}</code> · {} of {} runs "
      "finished{}</p><p>{}</p>",
      LinkTo(indexed, experiment.record.title), Escaped(experiment.record.name), finished,
      experiment.runs.size(),
      absent == 0 ? "" : fmt::format(", <b class=\"missed\">{} failed or missing</b>", absent),
      Escaped(experiment.record.description));
  if (!indexed.speed_svg.empty()) {
    html += "<figure class=\"plot\">" + InlineSvg(indexed.speed_svg, "Speed against error") +
            "</figure>";
  }
  if (!indexed.picture_png.empty()) {
    html += fmt::format("<img src=\"{}\" alt=\"Pictures of a run of {}\">",
                        DataUri(indexed.picture_png), Escaped(experiment.record.title));
  }
  return html + "</article>\n";
}

std::string ExperimentSection(const IndexContent& content) {
  std::string html = "<section id=\"experiments\"><h2>Experiments</h2>\n<div class=\"cards\">\n";
  for (const IndexedExperiment& indexed : content.experiments) html += ExperimentCard(indexed);
  return html + "</div></section>\n";
}

std::string RunRow(const IndexedExperiment& indexed, const ReportedRun& run,
                   const std::vector<Metric>& columns) {
  std::string html = "<tr>" + TextCell(LinkTo(indexed, indexed.experiment.record.name),
                                       indexed.experiment.record.name);
  const auto viewer = indexed.viewers.find(run.run_id);
  html +=
      fmt::format("<td class=\"run\" data-value=\"{}\">{}</td>", Escaped(run.run_id),
                  RunWithViewer(run.run_id, viewer == indexed.viewers.end() ? "" : viewer->second));
  if (!run.record) {
    return html + fmt::format("<td class=\"problem\" colspan=\"{}\">{}</td></tr>\n",
                              columns.size() + 1, Escaped(run.problem));
  }
  const std::string commit = run.record->provenance.is_object()
                                 ? run.record->provenance.value("commit", std::string("–"))
                                 : "–";
  html += TextCell("<code>" + Escaped(commit) + "</code>", commit);
  for (const Metric& column : columns) {
    const nlohmann::json cell = run.record->summary.value(column.key, nlohmann::json(nullptr));
    html += fmt::format("<td class=\"n\"{}>{}</td>",
                        cell.is_null() ? "" : fmt::format(" data-value=\"{}\"", cell.dump()),
                        PrintedCell(cell, column));
  }
  return html + "</tr>\n";
}

std::string RunSectionOfAll(const IndexContent& content) {
  const std::vector<Metric> columns = MetricsShownIn(Place::kIndexPage);
  std::vector<std::string> titles = {"experiment", "run", "commit"};
  for (const Metric& column : columns) titles.push_back(Titled(column));
  const bool any_viewer = std::ranges::any_of(
      content.experiments, [](const IndexedExperiment& e) { return !e.viewers.empty(); });
  std::string html =
      "<section id=\"runs\"><h2>All runs</h2><p class=\"soft\">A click on a column’s name sorts by "
      "it.</p>" +
      (any_viewer ? ViewerChoice(true, "") : "") + TableHead("sortable", titles);
  for (const IndexedExperiment& indexed : content.experiments) {
    for (const ReportedRun& run : indexed.experiment.runs) html += RunRow(indexed, run, columns);
  }
  return html + "</tbody></table></div></section>\n";
}

std::string GateSection(const IndexContent& content) {
  std::string html;
  for (const IndexedGate& gate : content.gates) {
    const bool good = gate.verdict.starts_with("ok");
    html += fmt::format(
        "<section id=\"gate\"><h2>Regression gate: {}</h2>\n<p><b class=\"{}\">{}</b> on {} at "
        "commit <code>{}</code>; <a href=\"{}\">summary</a></p>\n",
        Escaped(gate.name), good ? "met" : "missed", Escaped(gate.verdict), Escaped(gate.date),
        Escaped(gate.commit), Escaped(gate.link));
    for (const DrawnFigure& figure : gate.figures) html += FigureHtml(figure);
    html += "</section>\n";
  }
  return html;
}

std::string IndexHeader(const IndexContent& content) {
  std::size_t runs = 0, finished = 0;
  for (const IndexedExperiment& indexed : content.experiments) {
    runs += indexed.experiment.runs.size();
    finished += indexed.experiment.finished().size();
  }
  std::string problems;
  for (const std::string& problem : content.problems)
    problems += fmt::format("<p class=\"problem\">{}</p>", Escaped(problem));
  return fmt::format(
      "<header><h1>vitruvia: all experiments</h1><p class=\"soft\">{} experiments; {} of {} runs "
      "finished.</p>{}<nav><a href=\"#papers\">Figures and tables</a>{}<a "
      "href=\"#experiments\">Experiments</a><a href=\"#runs\">All runs</a></nav></header>\n",
      content.experiments.size(), finished, runs, problems,
      content.gates.empty() ? "" : "<a href=\"#gate\">Regression gate</a>");
}

}  // namespace

std::string MakeIndexPage(const IndexContent& content) {
  return PageOf("vitruvia: all experiments", IndexHeader(content) + "<main>\n" +
                                                 PaperSectionOfAll(content) + GateSection(content) +
                                                 ExperimentSection(content) +
                                                 RunSectionOfAll(content) + "</main>\n");
}

}  // namespace vitruvia
