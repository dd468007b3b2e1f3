// The lines of a text file held in memory, for parsers whose errors name file and line.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vitruvia {

class TextLines {
 public:
  // `file` is for messages; `content` must outlive this. A UTF-8 byte order mark is skipped. Lines
  // end with LF, CR LF or CR. DataError if the text is UTF-16.
  TextLines(std::string_view content, std::string file);

  bool Next();  // moves on to the next line; false at the end of the file
  std::string_view text() const { return text_; }
  std::vector<std::string_view> Words() const;    // of the line, split at blanks
  std::size_t position() const { return next_; }  // offset of the byte after the end of the line

  // DataError "file:line: problem".
  [[noreturn]] void Fail(std::string_view problem) const;

 private:
  std::string_view content_, text_;
  std::string file_;
  std::size_t next_ = 0;
  int line_ = 0;  // from 1
};

std::vector<std::string_view> SplitAtBlanks(std::string_view text);

// The text before a comment, which begins with a # at the start of a word.
std::string_view WithoutComment(std::string_view text);

// The number that the whole word represents, in C's notation; nothing if it is not a number.
std::optional<double> ParseNumber(std::string_view word);
std::optional<std::int64_t> ParseInteger(std::string_view word);

}  // namespace vitruvia
