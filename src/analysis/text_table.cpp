#include "analysis/text_table.h"

#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace vitruvia {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 21> kLatexSigns = {{
    {"\\", "\\textbackslash{}"},
    {"_", "\\_"},
    {"%", "\\%"},
    {"&", "\\&"},
    {"#", "\\#"},
    {"$", "\\$"},
    {"{", "\\{"},
    {"}", "\\}"},
    {"~", "\\textasciitilde{}"},
    {"^", "\\textasciicircum{}"},
    {"\n", " "},
    {"−", "$-$"},
    {"±", "$\\pm$"},
    {"≤", "$\\le$"},
    {"≥", "$\\ge$"},
    {"×", "$\\times$"},
    {"°", "$^\\circ$"},
    {"–", "--"},
    {"…", "\\ldots{}"},
    {"’", "'"},
    {"µ", "$\\mu$"},
}};

std::string WithoutBars(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, "\\");
  return text;
}

bool IsHeading(const std::vector<TextCell>& row, const TextTable& table) {
  return row.size() == 1 && table.head.size() > 1;
}

}  // namespace

std::string LatexEscaped(const std::string& text) {
  std::string escaped;
  for (std::size_t at = 0; at < text.size();) {
    std::string_view sign, command;
    for (const auto& [candidate, written] : kLatexSigns) {
      if (std::string_view(text).substr(at).starts_with(candidate)) {
        sign = candidate;
        command = written;
      }
    }
    if (sign.empty()) {
      escaped.push_back(text[at++]);
    } else {
      escaped.append(command);
      at += sign.size();
    }
  }
  return escaped;
}

namespace {

std::string LatexRow(const std::vector<std::string>& cells) {
  std::string row;
  for (std::size_t i = 0; i < cells.size(); ++i)
    row += (i == 0 ? "" : " & ") + LatexEscaped(cells[i]);
  return row + " \\\\\n";
}

// Units stand on a line of their own below the names, so that columns are no wider than they must.
std::string LatexHead(const std::vector<std::string>& head) {
  std::vector<std::string> names, units;
  bool has_units = false;
  for (const std::string& cell : head) {
    const std::size_t unit = cell.ends_with(')') ? cell.rfind(" (") : std::string::npos;
    names.push_back(cell.substr(0, unit));
    units.push_back(unit == std::string::npos ? "" : cell.substr(unit + 1));
    has_units = has_units || !units.back().empty();
  }
  return LatexRow(names) + (has_units ? LatexRow(units) : "");
}

}  // namespace

std::string ToLatex(const TextTable& table) {
  std::string text;
  for (const std::string& note : table.notes) text += fmt::format("% {}\n", note);
  text += fmt::format("\\begin{{tabular}}{{l{}}}\n\\toprule\n",
                      std::string(table.head.size() - 1, 'r'));
  text += LatexHead(table.head) + "\\midrule\n";
  for (const auto& row : table.rows) {
    if (IsHeading(row, table)) {
      text += fmt::format("{}\\multicolumn{{{}}}{{l}}{{\\emph{{{}}}}} \\\\\n",
                          &row == &table.rows.front() ? "" : "\\addlinespace\n", table.head.size(),
                          LatexEscaped(row[0].text));
      continue;
    }
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string cell = LatexEscaped(row[i].text);
      text += (i == 0 ? "" : " & ") +
              (row[i].bold ? fmt::format("\\textbf{{\\boldmath {}}}", cell) : cell);
    }
    text += " \\\\\n";
  }
  return text + "\\bottomrule\n\\end{tabular}\n";
}

std::string ToMarkdown(const TextTable& table) {
  std::string text = "|", rule = "|";
  for (std::size_t i = 0; i < table.head.size(); ++i) {
    text += fmt::format(" {} |", WithoutBars(table.head[i]));
    rule += i == 0 ? "---|" : "---:|";
  }
  text += "\n" + rule + "\n";
  for (const auto& row : table.rows) {
    text += "|";
    for (const TextCell& cell : row)
      text += fmt::format(" {0}{1}{0} |", cell.bold ? "**" : "", WithoutBars(cell.text));
    for (std::size_t i = row.size(); i < table.head.size(); ++i) text += " |";
    text += "\n";
  }
  for (const std::string& note : table.notes) text += "\n" + note + "\n";
  return text;
}

}  // namespace vitruvia
