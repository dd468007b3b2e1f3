#include "support/mutation.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vitruvia {
namespace {

using Json = nlohmann::json;
using Pointer = Json::json_pointer;

bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

bool IsNumber(const std::string& word) {
  return word.find_first_not_of("+-.0123456789eE") == std::string::npos &&
         word.find_first_of("0123456789") != std::string::npos;
}

// A place of a text: [begin, end).
struct Span {
  std::size_t begin = 0, end = 0;
};

std::vector<Span> WordsOf(const std::string& text) {
  std::vector<Span> words;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (IsBlank(text[i])) continue;
    if (i == 0 || IsBlank(text[i - 1])) words.push_back({i, i});
    words.back().end = i + 1;
  }
  return words;
}

// With the end of the line.
std::vector<Span> LinesOf(const std::string& text) {
  std::vector<Span> lines;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = text.find('\n', begin);
    lines.push_back({begin, end == std::string::npos ? text.size() : end + 1});
    begin = lines.back().end;
  }
  return lines;
}

std::string Replaced(const std::string& text, Span at, const std::string& by) {
  return text.substr(0, at.begin) + by + text.substr(at.end);
}

std::string TextAt(const std::string& text, Span at) {
  return text.substr(at.begin, at.end - at.begin);
}

// Junk that is no number, so that no number becomes another one.
std::string WithJunk(std::string word, RandomStream& random) {
  static const std::string kJunk = "#,;xX_{}()\xEF\x80\x01";
  const std::size_t at = random.Index(word.size());
  const char junk = kJunk[random.Index(kJunk.size())];
  switch (random.Index(3)) {
    case 0:
      word[at] = junk;
      return word;
    case 1:
      return word.substr(0, at) + junk + word.substr(at);
    default:
      return IsNumber(word) ? word + junk : word.erase(at, 1);
  }
}

std::string OtherNumber(std::string word, RandomStream& random) {
  const char* const kScales[] = {"1", "10", "0", "-", "00"};
  std::vector<std::size_t> digits;
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (word[i] >= '0' && word[i] <= '9') digits.push_back(i);
  }
  const std::size_t at = digits[random.Index(digits.size())];
  if (random.Index(2) == 0) {
    word[at] = static_cast<char>('0' + random.Index(10));
    return word;
  }
  return word.substr(0, at) + kScales[random.Index(std::size(kScales))] + word.substr(at);
}

Mutant WithLayout(const std::string& content, RandomStream& random) {
  std::string text = content;
  switch (random.Index(3)) {
    case 0:
      return {"\xEF\xBB\xBF" + text, Change::kLayout, "a byte order mark"};
    case 1:
      for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
        text.insert(at, "\r");
      return {text, Change::kLayout, "lines end with CR LF"};
    default:
      for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 3)
        text.insert(at, "  ");
      return {text, Change::kLayout, "blanks at the ends of lines"};
  }
}

// A number whose last digits are lost is a number.
Mutant Cut(const std::string& content, RandomStream& random) {
  const std::size_t size = random.Index(content.size());
  const bool inside_number = size > 0 && !IsBlank(content[size - 1]) && !IsBlank(content[size]);
  return {content.substr(0, size), inside_number ? Change::kStatement : Change::kDamage,
          fmt::format("cut after {} of {} bytes", size, content.size())};
}

Mutant WithWord(const std::string& content, RandomStream& random) {
  const std::vector<Span> words = WordsOf(content);
  const Span at = words[random.Index(words.size())];
  const std::string word = TextAt(content, at);
  const std::string where = fmt::format("byte {}, \"{}\"", at.begin, word);
  const auto mutant = [&](const std::string& by, Change change, const char* what) -> Mutant {
    return {Replaced(content, at, by), change, fmt::format("{} {}: \"{}\"", where, what, by)};
  };
  switch (random.Index(IsNumber(word) ? 7 : 4)) {
    case 0:
    case 1:
      return mutant(WithJunk(word, random), Change::kDamage, "with junk");
    case 2:
      return mutant("", Change::kDamage, "lost");
    case 3:
      return mutant(word + " " + word, Change::kDamage, "doubled");
    case 4: {
      static const std::vector<std::string> kNone = {"nan", "inf", "-inf", "1e999", "-1.#IND", "?"};
      return mutant(kNone[random.Index(kNone.size())], Change::kDamage, kNoNumber);
    }
    default:
      return mutant(OtherNumber(word, random), Change::kStatement, "as another number");
  }
}

Mutant WithLine(const std::string& content, RandomStream& random) {
  const std::vector<Span> lines = LinesOf(content);
  const std::size_t line = random.Index(lines.size());
  const bool doubled = random.Index(2) == 0;
  std::string text = TextAt(content, lines[line]);
  return {Replaced(content, lines[line], doubled ? text + text : ""), Change::kDamage,
          fmt::format("line {} {}", line + 1, doubled ? "doubled" : "lost")};
}

bool IsBelowFree(const std::string& place, const JsonRules& rules) {
  for (std::size_t end = place.find('/', 1);; end = place.find('/', end + 1)) {
    if (rules.is_free(place.substr(0, end))) return true;
    if (end == std::string::npos) return false;
  }
}

// All places of a document, the document itself left out.
void CollectPlaces(const Json& json, const Pointer& here, std::vector<Pointer>& places) {
  if (!json.is_structured()) return;
  for (const auto& item : json.items()) {
    const Pointer place = json.is_array() ? here / static_cast<std::size_t>(std::stoul(item.key()))
                                          : here / item.key();
    places.push_back(place);
    CollectPlaces(item.value(), place, places);
  }
}

bool SameType(const Json& a, const Json& b) {
  return a.type() == b.type() || (a.is_number() && b.is_number());
}

// The second has the keys of the first, with values of the same type, as far as the rules ask.
bool SameShape(const Json& whole, const Json& changed, const std::string& place,
               const JsonRules& rules) {
  if (!place.empty() && rules.is_free(place)) return true;
  if (!SameType(whole, changed)) return false;
  if (whole.is_array()) {
    for (std::size_t i = 0; i < changed.size(); ++i) {  // perhaps of another length or order
      const bool is_like_one = std::any_of(whole.begin(), whole.end(), [&](const Json& item) {
        return SameShape(item, changed[i], fmt::format("{}/{}", place, i), rules);
      });
      if (!is_like_one) return false;
    }
    return true;
  }
  if (!whole.is_object()) return true;
  for (const auto& [key, value] : whole.items()) {
    const std::string below = fmt::format("{}/{}", place, key);
    if (!changed.contains(key)) {
      if (!rules.keys_may_be_absent && !rules.is_free(below)) return false;
    } else if (!SameShape(value, changed.at(key), below, rules)) {
      return false;
    }
  }
  return std::all_of(changed.items().begin(), changed.items().end(), [&](const auto& item) {
    return whole.contains(item.key()) || rules.is_free(fmt::format("{}/{}", place, item.key()));
  });
}

Json Strange(RandomStream& random) {
  static const std::vector<Json> kValues = {nullptr,
                                            true,
                                            -1,
                                            0,
                                            1e300,
                                            -1e300,
                                            1e-300,
                                            9007199254740993,
                                            "",
                                            "NaN",
                                            "../../..",
                                            std::string(5000, 'a'),
                                            Json::array(),
                                            Json::object(),
                                            Json::array({1, "two", nullptr}),
                                            Json{{"x", {{"y", 1}}}}};
  return kValues[random.Index(kValues.size())];
}

Mutant WithPlace(const Json& whole, const JsonRules& rules, RandomStream& random) {
  std::vector<Pointer> places;
  CollectPlaces(whole, Pointer(), places);
  if (places.empty()) return {Strange(random).dump(), Change::kDamage, "another document"};
  const Pointer place = places[random.Index(places.size())];
  Json json = whole;
  Json& parent = json[place.parent_pointer()];
  const Json value = json[place];
  std::string what;
  switch (parent.is_object() ? random.Index(5) : random.Index(3)) {
    case 0:
    case 1:
      json[place] = Strange(random);
      what = fmt::format("another value: {:.60}", json[place].dump());
      break;
    case 2:
      if (parent.is_array()) {
        parent.erase(std::stoul(place.back()));
      } else {
        parent.erase(place.back());
      }
      what = "lost";
      break;
    case 3:
      parent.erase(place.back());
      what = "lost";
      break;
    default:
      parent.erase(place.back());
      parent[place.back() + "x"] = value;
      what = "renamed";
      break;
  }
  const bool is_statement =
      IsBelowFree(place.to_string(), rules) || SameShape(whole, json, "", rules);
  return {json.dump(1, ' ', false, Json::error_handler_t::replace),
          is_statement ? Change::kStatement : Change::kDamage,
          fmt::format("{} {}", place.to_string(), what)};
}

}  // namespace

Mutant MutateText(const std::string& content, RandomStream& random) {
  if (content.empty()) return {"x", Change::kDamage, "junk in an empty file"};
  switch (random.Index(12)) {
    case 0:
      return WithLayout(content, random);
    case 1:
      return Cut(content, random);
    case 2:
    case 3:
    case 4:
      return WithLine(content, random);
    default:
      return WithWord(content, random);
  }
}

Mutant MutateBytes(const std::string& content, std::size_t header_bytes, RandomStream& random) {
  const std::size_t at = random.Index(content.size());
  const std::size_t count = 1 + random.Index(8);
  const auto mutant = [&](std::string text, Change change, const char* what) -> Mutant {
    return {std::move(text), change, fmt::format("byte {} of {}: {}", at, content.size(), what)};
  };
  switch (random.Index(5)) {
    case 0:
      return mutant(content.substr(0, at), Change::kDamage, "cut");
    case 1: {
      std::string junk;
      for (std::size_t i = 0; i < count; ++i) junk += static_cast<char>(random.Index(256));
      return mutant(content.substr(0, at) + junk + content.substr(at), Change::kDamage, "added");
    }
    case 2:
      return mutant(Replaced(content, {at, std::min(content.size(), at + count)}, ""),
                    Change::kDamage, "lost");
    default: {
      // Half of them in the first bytes, where counts and marks are.
      const std::size_t place =
          random.Index(2) == 0 ? random.Index(std::min<std::size_t>(content.size(), 400)) : at;
      std::string text = content;
      for (std::size_t i = place; i < std::min(content.size(), place + count); ++i)
        text[i] = static_cast<char>(random.Index(256));
      return {std::move(text), place < header_bytes ? Change::kDamage : Change::kStatement,
              fmt::format("{} bytes from {} on overwritten", count, place)};
    }
  }
}

Mutant MutateJson(const std::string& content, const JsonRules& rules, RandomStream& random) {
  const Json whole = Json::parse(content);
  if (random.Index(3) != 0) return WithPlace(whole, rules, random);
  Mutant mutant = MutateText(content, random);
  const Json damaged = Json::parse(mutant.content, nullptr, false);
  if (damaged.is_discarded()) {
    if (mutant.change == Change::kStatement) mutant.change = Change::kDamage;
  } else if (damaged != whole) {
    mutant.change = SameShape(whole, damaged, "", rules) ? Change::kStatement : Change::kDamage;
  }
  return mutant;
}

}  // namespace vitruvia
