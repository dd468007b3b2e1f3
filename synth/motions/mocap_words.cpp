#include "synth/motions/mocap_words.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/files.h"

namespace vitruvia {
namespace {

constexpr std::string_view kBlank = " \t\f\v";
constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";
// Millimetres of a walk over a thousand kilometres: no length or angle of a file is larger.
constexpr double kLargestNumber = 1e9;

// The numeric value of a whole word; false if it is none.
template <class Value>
bool Parse(std::string_view text, Value& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

// Why a word that stands for a number is none, "" if nothing is known of it.
std::string_view LikelyCause(std::string_view text) {
  if (text.find('#') != std::string_view::npos) {
    return " (some Windows programs write values that are not numbers so)";
  }
  if (text.find(',') != std::string_view::npos) return " (a decimal comma?)";
  return "";
}

char Lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

bool SameWord(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) { return Lower(x) == Lower(y); });
}

MocapWords::MocapWords(const std::filesystem::path& file)
    : file_(file), content_(ReadWholeFile(file)) {
  RequireText();
  std::string_view rest = content_;
  if (rest.starts_with(kUtf8Mark)) rest.remove_prefix(kUtf8Mark.size());
  for (int line = 1; !rest.empty(); ++line) {
    const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
    AddWords(rest.substr(0, end), line);
    rest.remove_prefix(end);
    rest.remove_prefix(rest.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, rest.size()));
  }
}

void MocapWords::RequireText() const {
  if (content_.starts_with("\xFF\xFE") || content_.starts_with("\xFE\xFF")) {
    Fail(1, "the text is UTF-16; expected ASCII or UTF-8: save the file in that encoding");
  }
  if (const std::size_t zero = content_.find('\0'); zero != std::string::npos) {
    const auto begin = content_.begin();
    const auto lines = std::count(begin, begin + static_cast<std::ptrdiff_t>(zero), '\n');
    Fail(static_cast<int>(lines) + 1, "a zero byte: the file is damaged or no text");
  }
}

void MocapWords::AddWords(std::string_view line_text, int line) {
  while (true) {
    const std::size_t first = line_text.find_first_not_of(kBlank);
    if (first == std::string_view::npos || line_text[first] == '#') return;
    line_text.remove_prefix(first);
    const std::size_t length = std::min(line_text.find_first_of(kBlank), line_text.size());
    words_.push_back({line_text.substr(0, length), line});
    line_text.remove_prefix(length);
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
  if (!SameWord(word.text, keyword)) {
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

std::vector<MocapWords::Word> MocapWords::TakeLine() { return TakeRestOf(Peek().line); }

std::vector<MocapWords::Word> MocapWords::TakeRestOf(int line) {
  std::vector<Word> words;
  while (!AtEnd() && words_[next_].line == line) words.push_back(words_[next_++]);
  return words;
}

double MocapWords::Number(const Word& word, std::string_view what) const {
  double value = 0.0;
  if (!Parse(word.text, value) || !std::isfinite(value)) {
    Fail(word.line,
         fmt::format("{}: expected a number, got {}{}", what, word.text, LikelyCause(word.text)));
  }
  if (std::abs(value) > kLargestNumber) {
    Fail(word.line,
         fmt::format("{}: expected at most {:g}, got {}", what, kLargestNumber, word.text));
  }
  return value;
}

void MocapWords::Fail(int line, std::string_view problem) const {
  throw DataError(At(line, problem));
}

std::string MocapWords::At(int line, std::string_view text) const {
  return fmt::format("{}:{}: {}", file_.string(), line, text);
}

}  // namespace vitruvia
