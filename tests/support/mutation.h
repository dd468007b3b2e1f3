// Seeded damage to the content of files.
#pragma once

#include <functional>
#include <string>

#include "core/random.h"

namespace vitruvia {

// What a mutation can have done to the meaning of a file.
enum class Change {
  kLayout,     // nothing: ends of lines, blanks, a byte order mark
  kDamage,     // the file is not whole any more, or not of its format
  kStatement,  // it is a whole file of its format that says something else
};

struct Mutant {
  std::string content;
  Change change = Change::kDamage;
  std::string what;  // for messages: "line 12 doubled"
};

// Part of `what` where a number is replaced by what is none, such as nan.
inline constexpr const char* kNoNumber = "that is no number";

// Text of words and lines: junk in a word, words and lines lost or doubled, numbers that are none,
// the file cut (damage); another digit, sign or size of a number (statement); layout. Lines are not
// exchanged: a format with many lines of one kind holds another statement then. Damage never makes
// one number of another.
Mutant MutateText(const std::string& content, RandomStream& random);

// Numbers in the order of a layout, behind a header of text perhaps: bytes lost, added or the file
// cut, and overwritten bytes of the header (damage); other overwritten bytes (statement).
Mutant MutateBytes(const std::string& content, std::size_t header_bytes, RandomStream& random);

// What a format of JSON leaves open.
struct JsonRules {
  // Of a place, "/frames/0/name": whether it may be absent or hold anything.
  std::function<bool(const std::string& place)> is_free = [](const auto&) { return false; };
  bool keys_may_be_absent = false;  // every key has a default, as in configs
};

// JSON: values of another type, keys lost or renamed, text cut or no JSON any more (damage);
// another value of the same type, a list of another length, changes of what the rules leave open
// (statement); layout.
Mutant MutateJson(const std::string& content, const JsonRules& rules, RandomStream& random);

}  // namespace vitruvia
