// CSV and LaTeX forms of the tables.
#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "analysis/tables.h"
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

std::string LatexEscaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (std::string_view("_%&#${}").find(c) != std::string_view::npos) {
      escaped.append({'\\', c});
    } else if (c == '\\') {
      escaped.append("\\textbackslash{}");
    } else if (c == '~') {
      escaped.append("\\textasciitilde{}");
    } else if (c == '^') {
      escaped.append("\\textasciicircum{}");
    } else {
      escaped.push_back(c == '\n' ? ' ' : c);
    }
  }
  return escaped;
}

// Typographic signs as LaTeX's default encodings know them.
std::string LatexNumber(const std::string& printed) {
  if (printed == kNoNumber) return "--";
  const std::string minus = "−";
  const std::size_t at = printed.find(minus);
  if (at == std::string::npos) return LatexEscaped(printed);
  return fmt::format("$-${}", LatexEscaped(printed.substr(at + minus.size())));
}

const char* LatexVerdict(Verdict verdict) {
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
  return "--";
}

std::string LatexComparison(const ReportedExperiment& experiment) {
  std::string rows;
  for (const Comparison& c : CompareWithPapers(experiment)) {
    rows += fmt::format("\\midrule\n\\multicolumn{{6}}{{l}}{{{}, {}}} \\\\\n",
                        LatexEscaped(Titled(c.metric)), LatexEscaped(c.expectation.source));
    for (const ComparedRun& run : c.runs) {
      const std::string result =
          run.problem.empty()
              ? fmt::format("{} & {}", LatexNumber(run.ours), LatexNumber(run.difference))
              : fmt::format("\\multicolumn{{2}}{{l}}{{{}}}", LatexEscaped(run.problem));
      rows += fmt::format(
          "\\texttt{{{}}} & {} & {} & {} & {} \\\\\n", LatexEscaped(run.run_id),
          LatexNumber(c.paper), result,
          c.target.empty() ? "--"
                           : (c.more_is_better() ? "$\\ge$ " : "$\\le$ ") + LatexNumber(c.target),
          LatexVerdict(run.verdict));
    }
  }
  return "\\begin{tabular}{lrrrrl}\n\\toprule\n"
         "run & paper & ours & difference & target & \\\\\n" +
         rows + "\\bottomrule\n\\end{tabular}\n";
}

std::string LatexSummary(const ReportedExperiment& experiment) {
  const SummaryTable table = MakeSummaryTable(experiment);
  std::string header, rows;
  for (const Metric& column : table.columns) {
    header += fmt::format("{}{}", header.empty() ? "" : " & ", LatexEscaped(Titled(column)));
  }
  for (const SummaryTable::Row& row : table.rows) {
    rows += fmt::format("\\texttt{{{}}}", LatexEscaped(row.run_id));
    if (!row.problem.empty()) {
      rows += fmt::format(" & \\multicolumn{{{}}}{{l}}{{{}}}", table.columns.size() - 1,
                          LatexEscaped(row.problem));
    } else {
      for (std::size_t i = 1; i < table.columns.size(); ++i) {
        rows += fmt::format(" & {}", LatexNumber(PrintedCell(row.cells[i], table.columns[i])));
      }
    }
    rows += " \\\\\n";
  }
  return fmt::format(
      "\\begin{{tabular}}{{l{}}}\n\\toprule\n{} "
      "\\\\\n\\midrule\n{}\\bottomrule\n\\end{{tabular}}\n",
      std::string(table.columns.size() - 1, 'r'), header, rows);
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
  return fmt::format("% {}: {}\n% needs \\usepackage{{booktabs}}\n\n{}\n{}", experiment.record.name,
                     experiment.record.title, LatexComparison(experiment),
                     LatexSummary(experiment));
}

}  // namespace vitruvia
