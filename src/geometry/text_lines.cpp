#include "geometry/text_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"

namespace vitruvia {
namespace {

constexpr std::string_view kBlanks = " \t\v\f";
constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";

template <class Number>
std::optional<Number> Parse(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || end == word.data()) return std::nullopt;
  if (error == std::errc()) return value;
  return std::nullopt;
}

}  // namespace

TextLines::TextLines(std::string_view content, std::string file)
    : content_(content), file_(std::move(file)) {
  if (content_.starts_with("\xFF\xFE") || content_.starts_with("\xFE\xFF")) {
    throw DataError(fmt::format("{}: is UTF-16 text, expected UTF-8 or ASCII", file_));
  }
  if (content_.starts_with(kUtf8Mark)) next_ = kUtf8Mark.size();
}

bool TextLines::Next() {
  if (next_ >= content_.size()) {
    text_ = {};
    return false;
  }
  const std::size_t end = std::min(content_.find_first_of("\r\n", next_), content_.size());
  text_ = content_.substr(next_, end - next_);
  next_ = std::min(end + 1, content_.size());
  if (content_.substr(end, 2) == "\r\n") ++next_;
  ++line_;
  return true;
}

std::vector<std::string_view> TextLines::Words() const { return SplitAtBlanks(text_); }

void TextLines::Fail(std::string_view problem) const {
  throw DataError(fmt::format("{}:{}: {}", file_, line_, problem));
}

std::string_view WithoutComment(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '#' && (i == 0 || kBlanks.find(text[i - 1]) != std::string_view::npos))
      return text.substr(0, i);
  }
  return text;
}

std::vector<std::string_view> SplitAtBlanks(std::string_view text) {
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return words;
    const std::size_t end = std::min(text.find_first_of(kBlanks, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    text.remove_prefix(end);
  }
}

std::optional<double> ParseNumber(std::string_view word) { return Parse<double>(word); }

std::optional<std::int64_t> ParseInteger(std::string_view word) {
  return Parse<std::int64_t>(word);
}

}  // namespace vitruvia
