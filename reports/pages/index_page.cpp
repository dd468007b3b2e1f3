#include "reports/pages/index_page.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "analysis/tables.h"
#include "records/metric_value.h"
#include "reports/drawing/html_text.h"
#include "reports/pages/page_assets.h"

namespace vitruvia {
namespace {

constexpr std::array kIndexColumns = {"frames",
                                      "frames_failed",
                                      "l2_mean_of_diagonal",
                                      "l2_max_of_diagonal",
                                      "joints_within_10cm",
                                      "frame_ms_median",
                                      "frame_ms_p95",
                                      "surface_mean_m",
                                      "surface_max_m"};

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
    const double value = MetricValue(*run, comparison.expectation.metric);
    if (std::isnan(value) || !comparison.expectation.IsAbout(run->scene)) continue;
    ours.least = std::isnan(ours.least) ? value : std::min(ours.least, value);
    ours.most = std::isnan(ours.most) ? value : std::max(ours.most, value);
  }
  return ours;
}

std::string OursText(const OursInAll& ours, const MetricName& metric) {
  if (std::isnan(ours.least)) return "–";
  const std::string least = Printed(ours.least, metric), most = Printed(ours.most, metric);
  return least == most ? least : fmt::format("{} … {}", least, most);
}

// Sorted by data-value: what is met, what nobody asked for, what is missing, what is missed.
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
  if (!indexed.picture_png.empty()) {
    html += fmt::format("<img src=\"{}\" alt=\"Pictures of a run of {}\">",
                        DataUri(indexed.picture_png), Escaped(experiment.record.title));
  }
  if (const std::size_t at = indexed.speed_svg.find("<svg"); at != std::string::npos) {
    html += fmt::format(
        "<figure class=\"plot\"><svg role=\"img\" aria-label=\"Speed against error\"{}</figure>",
        indexed.speed_svg.substr(at + 4));
  }
  return html + "</article>\n";
}

std::string ExperimentSection(const IndexContent& content) {
  std::string html = "<section id=\"experiments\"><h2>Experiments</h2>\n<div class=\"cards\">\n";
  for (const IndexedExperiment& indexed : content.experiments) html += ExperimentCard(indexed);
  return html + "</div></section>\n";
}

std::string RunRow(const IndexedExperiment& indexed, const ReportedRun& run) {
  std::string html = "<tr>" + TextCell(LinkTo(indexed, indexed.experiment.record.name),
                                       indexed.experiment.record.name);
  html += fmt::format("<td class=\"run\" data-value=\"{0}\">{0}</td>", Escaped(run.run_id));
  if (!run.record) {
    return html + fmt::format("<td class=\"problem\" colspan=\"{}\">{}</td></tr>\n",
                              kIndexColumns.size() + 1, Escaped(run.problem));
  }
  const std::string commit = run.record->provenance.is_object()
                                 ? run.record->provenance.value("commit", std::string("–"))
                                 : "–";
  html += TextCell("<code>" + Escaped(commit) + "</code>", commit);
  for (const char* key : kIndexColumns) {
    const double value = MetricValue(*run.record, key);
    const bool counted =
        run.record->summary.contains(key) && run.record->summary.at(key).is_number_integer();
    html += std::isnan(value) ? std::string("<td class=\"n\">–</td>")
                              : fmt::format("<td class=\"n\" data-value=\"{}\">{}</td>", value,
                                            counted ? fmt::format("{:.0f}", value)
                                                    : Printed(value, NameOfMetric(key)));
  }
  return html + "</tr>\n";
}

std::string RunSectionOfAll(const IndexContent& content) {
  std::vector<std::string> columns = {"experiment", "run", "commit"};
  for (const char* key : kIndexColumns) columns.push_back(Titled(NameOfMetric(key)));
  std::string html =
      "<section id=\"runs\"><h2>All runs</h2><p class=\"soft\">A click on a column’s name sorts by "
      "it.</p>" +
      TableHead("sortable", columns);
  for (const IndexedExperiment& indexed : content.experiments) {
    for (const ReportedRun& run : indexed.experiment.runs) html += RunRow(indexed, run);
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
    for (const DrawnFigure& figure : gate.figures) {
      const std::size_t at = figure.svg.find("<svg");
      html += fmt::format(
          "<figure class=\"plot\"><figcaption><b>{0}</b>{1}</figcaption><div class=\"scroll\"><svg "
          "role=\"img\" aria-label=\"{0}\"{2}</div></figure>\n",
          Escaped(figure.title), Escaped(figure.caption), figure.svg.substr(at + 4));
    }
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
  return fmt::format(
             "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta "
             "name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
             "<title>vitruvia: all experiments</title><link rel=\"icon\" href=\"data:,\">"
             "<style>{}</style></head><body>\n",
             kPageStyle) +
         IndexHeader(content) + "<main>\n" + PaperSectionOfAll(content) + GateSection(content) +
         ExperimentSection(content) + RunSectionOfAll(content) + "</main>\n<script>" + kPageScript +
         "</script>\n</body></html>\n";
}

}  // namespace vitruvia
