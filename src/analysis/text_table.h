// Tables of printed cells, as LaTeX and Markdown.
#pragma once

#include <string>
#include <vector>

namespace vitruvia {

struct TextCell {
  std::string text;
  bool bold = false;
};

// The first column is left-aligned, the others are right-aligned. A row of a single cell is a
// heading over the rows that follow.
struct TextTable {
  std::vector<std::string> head;
  std::vector<std::vector<TextCell>> rows;
  std::vector<std::string> notes;  // sentences that explain the numbers
};

// A tabular in booktabs style; the notes precede it as comments.
std::string ToLatex(const TextTable& table);
// A table in GitHub's Markdown; the notes follow it.
std::string ToMarkdown(const TextTable& table);

// Plain text as LaTeX source: special characters are escaped, typographic ones replaced by
// commands.
std::string LatexEscaped(const std::string& text);

}  // namespace vitruvia
