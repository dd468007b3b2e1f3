// CSV and LaTeX forms of the tables.
#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "analysis/tables.h"
#include "analysis/variant_comparison.h"
#include "records/metric_value.h"

namespace vitruvia {
namespace {

// RFC 4180.
std::string CsvCell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + "\"";
}

// Numbers as stored, to the last digit; null is an empty cell.
std::string CsvCell(const nlohmann::json& cell) {
  if (cell.is_null()) return "";
  return CsvCell(cell.is_string() ? cell.get<std::string>() : cell.dump());
}

std::string CsvStatus(const std::string& problem) { return problem.empty() ? "done" : problem; }

const char* Word(Verdict verdict) {
  switch (verdict) {
    case Verdict::kMet:
      return "met";
    case Verdict::kMissed:
      return "missed";
    case Verdict::kNotComparable:
      return "not comparable";
    case Verdict::kNoTarget:
    case Verdict::kNoResult:
      break;
  }
  return "–";
}

TextTable PaperTable(const ReportedExperiment& experiment) {
  TextTable table{{"run", "metric", "paper", "ours", "difference", "target", "verdict"}, {}, {}};
  for (const Comparison& c : CompareWithPapers(experiment)) {
    const std::string target =
        c.target.empty() ? kNoNumber : (c.more_is_better() ? "≥ " : "≤ ") + c.target;
    for (const ComparedRun& run : c.runs) {
      table.rows.push_back({{run.run_id},
                            {Titled(c.metric)},
                            {c.paper},
                            {run.problem.empty() ? run.ours : run.problem},
                            {run.difference},
                            {target},
                            {Word(run.verdict)}});
    }
    table.notes.push_back(fmt::format("{}: {}. {}", Titled(c.metric), c.expectation.source,
                                      c.expectation.not_comparable.empty()
                                          ? c.expectation.remark
                                          : "Not comparable: " + c.expectation.not_comparable));
  }
  return table;
}

// For an experiment without a finished run: each run and why it has no result.
TextTable ProblemTable(const ReportedExperiment& experiment) {
  TextTable table{{"run", "status"}, {}, {}};
  for (const auto& run : experiment.runs) table.rows.push_back({{run.run_id}, {run.problem}});
  return table;
}

// The variants' table and the comparison with the papers, without those that have no row.
std::vector<TextTable> TablesOf(const ReportedExperiment& experiment) {
  const bool one_variant = ContendersOf(experiment).size() < 2;
  std::vector<TextTable> tables = {one_variant ? ToText(TabulateScenes(experiment), "scene")
                                               : ToText(TabulateVariants(experiment), "variant"),
                                   PaperTable(experiment)};
  std::erase_if(tables, [](const TextTable& table) { return table.rows.empty(); });
  return tables.empty() ? std::vector{ProblemTable(experiment)} : tables;
}

// Those that a column of differences can be taken from.
std::vector<Expectation> PublishedNumbers(const ExperimentRecord& experiment) {
  std::vector<Expectation> published;
  std::copy_if(
      experiment.expectations.begin(), experiment.expectations.end(), std::back_inserter(published),
      [](const Expectation& e) { return !std::isnan(e.paper) && e.not_comparable.empty(); });
  return published;
}

}  // namespace

std::string ToCsv(const ReportedExperiment& experiment) {
  const SummaryTable table = MakeSummaryTable(experiment);
  std::string csv;
  for (const Metric& column : table.columns) csv += CsvCell(column.key) + ",";
  csv += "status";
  const std::vector<Expectation> published = PublishedNumbers(experiment.record);
  for (const Expectation& e : published) csv += fmt::format(",{0}_paper,{0}_difference", e.metric);
  csv += "\r\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const SummaryTable::Row& row = table.rows[r];
    for (const nlohmann::json& cell : row.cells) csv += CsvCell(cell) + ",";
    csv += CsvCell(CsvStatus(row.problem));
    for (const Expectation& e : published) {
      const auto& record = experiment.runs[r].record;
      const bool about = !record || e.IsAbout(record->scene);
      csv += fmt::format(",{},", about ? CsvCell(nlohmann::json(e.paper)) : "");
      const double ours = about && record ? MetricValue(*record, e.metric) : NAN;
      if (!std::isnan(ours)) csv += CsvCell(nlohmann::json(ours - e.paper));
    }
    csv += "\r\n";
  }
  return csv;
}

std::string ToLatex(const ReportedExperiment& experiment) {
  std::string text = fmt::format("% {}: {}\n% needs \\usepackage{{booktabs}}\n",
                                 experiment.record.name, experiment.record.title);
  for (const TextTable& table : TablesOf(experiment)) text += "\n" + ToLatex(table);
  return text;
}

std::string ToMarkdown(const ReportedExperiment& experiment) {
  std::string text = fmt::format("# {}\n", experiment.record.title);
  for (const TextTable& table : TablesOf(experiment)) text += "\n" + ToMarkdown(table);
  return text;
}

}  // namespace vitruvia
