// The words of a text file with their lines, for parsers whose errors name file and line.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vitruvia {

class MocapWords {
 public:
  struct Word {
    std::string_view text;
    int line = 0;  // from 1
  };

  // Reads the whole file; what follows a # on a line is left out. DataError if it cannot be read.
  explicit MocapWords(const std::filesystem::path& file);
  MocapWords(const MocapWords&) = delete;
  MocapWords& operator=(const MocapWords&) = delete;

  bool AtEnd() const { return next_ == words_.size(); }
  int line() const;          // of the next word; at the end, of the last one
  const Word& Peek() const;  // misuse at the end
  // The next word, or DataError that the file ends where `expected` was due.
  Word Take(std::string_view expected);
  void TakeKeyword(std::string_view keyword);  // or DataError
  double TakeNumber(std::string_view what);    // finite, or DataError
  int TakeCount(std::string_view what);        // ≥ 0, or DataError
  std::vector<Word> TakeLine();  // all words of the next word's line; misuse at the end

  double Number(const Word& word, std::string_view what) const;  // finite, or DataError
  [[noreturn]] void Fail(int line, std::string_view problem) const;

 private:
  std::filesystem::path file_;
  std::string content_;
  std::vector<Word> words_;
  std::size_t next_ = 0;
};

}  // namespace vitruvia
