// The words of a text file with their lines, for parsers whose errors name file and line.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vitruvia {

// Equal but for upper and lower case (ASCII).
bool SameWord(std::string_view a, std::string_view b);

class MocapWords {
 public:
  struct Word {
    std::string_view text;
    int line = 0;  // from 1
  };

  // Reads the whole file. A word that begins with # starts a comment, which ends with the line; a #
  // inside a word belongs to the word. A UTF-8 byte order mark is skipped. Lines end with LF, CR or
  // both. DataError if the file cannot be read, is UTF-16 or holds a zero byte.
  explicit MocapWords(const std::filesystem::path& file);
  MocapWords(const MocapWords&) = delete;
  MocapWords& operator=(const MocapWords&) = delete;

  bool AtEnd() const { return next_ == words_.size(); }
  int line() const;          // of the next word; at the end, of the last one
  const Word& Peek() const;  // misuse at the end
  // The next word, or DataError that the file ends where `expected` was due.
  Word Take(std::string_view expected);
  void TakeKeyword(std::string_view keyword);  // in any case, or DataError
  double TakeNumber(std::string_view what);    // see Number
  int TakeCount(std::string_view what);        // ≥ 0, or DataError
  std::vector<Word> TakeLine();  // all words of the next word's line; misuse at the end
  // The rest of the line of the next word; empty if that word is not on `line`.
  std::vector<Word> TakeRestOf(int line);

  // A finite number of a plausible size for a length or angle; otherwise DataError with the likely
  // cause.
  double Number(const Word& word, std::string_view what) const;
  [[noreturn]] void Fail(int line, std::string_view problem) const;
  std::string At(int line, std::string_view text) const;  // "file:line: text"

 private:
  void RequireText() const;
  void AddWords(std::string_view line_text, int line);

  std::filesystem::path file_;
  std::string content_;
  std::vector<Word> words_;
  std::size_t next_ = 0;
};

}  // namespace vitruvia
