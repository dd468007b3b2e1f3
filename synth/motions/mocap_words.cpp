#include "synth/motions/mocap_words.h"

#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/files.h"

namespace vitruvia {
namespace {

constexpr std::string_view kBlank = " \t\r\f\v";

// The numeric value of a whole word; false if it is none.
template <class Value>
bool Parse(std::string_view text, Value& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

MocapWords::MocapWords(const std::filesystem::path& file)
    : file_(file), content_(ReadWholeFile(file)) {
  const std::string_view content = content_;
  std::size_t begin = 0;
  for (int line = 1; begin < content.size(); ++line) {
    const std::size_t end = std::min(content.find('\n', begin), content.size());
    std::string_view rest = content.substr(begin, end - begin);
    rest = rest.substr(0, rest.find('#'));
    while (true) {
      const std::size_t first = rest.find_first_not_of(kBlank);
      if (first == std::string_view::npos) break;
      rest.remove_prefix(first);
      const std::size_t length = std::min(rest.find_first_of(kBlank), rest.size());
      words_.push_back({rest.substr(0, length), line});
      rest.remove_prefix(length);
    }
    begin = end + 1;
  }
}

int MocapWords::line() const {
  if (words_.empty()) return 1;
  return AtEnd() ? words_.back().line : words_[next_].line;
}

const MocapWords::Word& MocapWords::Peek() const {
  Require(!AtEnd(), "{}: no word left", file_.string());
  return words_[next_];
}

MocapWords::Word MocapWords::Take(std::string_view expected) {
  if (AtEnd()) Fail(line(), fmt::format("the file ends here, expected {}", expected));
  return words_[next_++];
}

void MocapWords::TakeKeyword(std::string_view keyword) {
  const Word word = Take(keyword);
  if (word.text != keyword) {
    Fail(word.line, fmt::format("expected {}, got {}", keyword, word.text));
  }
}

double MocapWords::TakeNumber(std::string_view what) { return Number(Take(what), what); }

int MocapWords::TakeCount(std::string_view what) {
  const Word word = Take(what);
  int value = 0;
  if (!Parse(word.text, value) || value < 0) {
    Fail(word.line, fmt::format("{}: expected a whole number, got {}", what, word.text));
  }
  return value;
}

std::vector<MocapWords::Word> MocapWords::TakeLine() {
  const int line = Peek().line;
  std::vector<Word> words;
  while (!AtEnd() && words_[next_].line == line) words.push_back(words_[next_++]);
  return words;
}

double MocapWords::Number(const Word& word, std::string_view what) const {
  double value = 0.0;
  if (!Parse(word.text, value) || !std::isfinite(value)) {
    Fail(word.line, fmt::format("{}: expected a number, got {}", what, word.text));
  }
  return value;
}

void MocapWords::Fail(int line, std::string_view problem) const {
  throw DataError(fmt::format("{}:{}: {}", file_.string(), line, problem));
}

}  // namespace vitruvia
