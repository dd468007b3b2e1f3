// Tables of printed cells, as LaTeX and Markdown.
#pragma once

#include <string>
#include <vector>

namespace vitruvia {

struct TextCell {
  std::string text;
  bool bold = false;
};

// The first column is set to the left, the others to the right. A row of a single cell is a heading
// over the rows that follow.
struct TextTable {
  std::vector<std::string> head;
  std::vector<std::vector<TextCell>> rows;
  std::vector<std::string> notes;  // sentences that say what the numbers are
};

// A tabular with the rules of booktabs; the notes stand before it as comments.
std::string ToLatex(const TextTable& table);
// A table of GitHub's Markdown; the notes stand below it.
std::string ToMarkdown(const TextTable& table);

// Plain text as LaTeX sets it: characters of its own escaped, typographic ones as commands.
std::string LatexEscaped(const std::string& text);

}  // namespace vitruvia
