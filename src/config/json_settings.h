// Strict JSON for settings (see settings.h).
//
// Reading: keys that are absent keep their defaults; an unknown key, a wrong type, a value out of
// range or a missing required key throws ConfigError naming file, key path, value, what was
// expected, and for an unknown key the nearest valid one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "config/settings.h"
#include "core/error.h"

namespace vitruvia {

using Json = nlohmann::json;

// Where a JSON value came from: for messages, and for paths relative to the file.
struct JsonOrigin {
  std::filesystem::path file;  // as the user named it
  std::string path;            // key path of the value inside the file, "" for the whole
};

// Parses a whole file. Throws ConfigError (with line and column) if it is missing or is no JSON,
// or if an object holds a key twice.
Json ReadJsonFile(const std::filesystem::path& file);

// `base` with RFC 7386 merge-patch `overrides` applied.
Json Merged(Json base, const Json& overrides);

namespace internal {
void ReadSettingsWith(const Json& json, const JsonOrigin& origin, void* settings,
                      void (*visit)(Fields&, void*));
Json WriteSettingsWith(void* settings, void (*visit)(Fields&, void*));
}  // namespace internal

template <class Struct>
Struct ReadSettings(const Json& json, const JsonOrigin& origin) {
  Struct settings;
  internal::ReadSettingsWith(json, origin, &settings, [](Fields& fields, void* s) {
    fields.Visit(*static_cast<Struct*>(s));
  });
  return settings;
}

template <class Struct>
Struct ReadSettingsFile(const std::filesystem::path& file) {
  return ReadSettings<Struct>(ReadJsonFile(file), {file, ""});
}

// The same strict reader for files of data, the headers of our own formats: what is wrong is
// damaged data there, so DataError is thrown.
template <class Struct>
Struct ReadDataFile(const std::filesystem::path& file) {
  try {
    return ReadSettingsFile<Struct>(file);
  } catch (const ConfigError& error) {
    throw DataError(error.what());
  }
}

// The resolved settings, every key present.
template <class Struct>
Json WriteSettings(Struct settings) {
  return internal::WriteSettingsWith(
      &settings, [](Fields& fields, void* s) { fields.Visit(*static_cast<Struct*>(s)); });
}

// One line of `vitruvia explain`.
struct FieldDescription {
  std::string key;   // dotted path
  std::string type;  // number, integer, flag, text, file, choice, list, …
  std::string meaning, unit, range, default_value, origin, source;
};

// Every field of a settings struct, depth first, also those that depend on a choice.
std::vector<FieldDescription> DescribeSettings(const std::string& prefix, void (*visit)(Fields&));

template <class Struct>
std::vector<FieldDescription> Describe(const std::string& prefix) {
  return DescribeSettings(prefix, [](Fields& fields) {
    Struct settings;
    fields.Visit(settings);
  });
}

// The candidate nearest to `word` by edit distance, or "" if none is near.
std::string NearestWord(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace vitruvia
