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

// Where a JSON value was read from: needed for error messages and to resolve paths relative to the
// file.
struct JsonOrigin {
  std::filesystem::path file;  // as the user named it
  std::string path;            // key path of the value inside the file, "" for the whole
};

// Parses a whole file. Throws ConfigError (with line and column) if it is missing or not valid
// JSON, or if an object contains a key twice.
Json ReadJsonFile(const std::filesystem::path& file);

// `base` with RFC 7386 merge-patch `overrides` applied.
Json Merged(Json base, const Json& overrides);

// Which rules apply to missing keys: in settings they keep their defaults; stored data must hold
// every key that its description does not mark as optional (stored_data.h).
enum class FileKind { kSettings, kStoredData };

namespace internal {
void ReadFields(const Json& json, const JsonOrigin& origin, FileKind kind, void* value,
                void (*visit)(Fields&, void*));
// In the order of the description.
nlohmann::ordered_json WriteFields(void* value, void (*visit)(Fields&, void*));
template <class Struct>
void VisitFields(Fields& fields, void* value) {
  fields.Visit(*static_cast<Struct*>(value));
}
}  // namespace internal

template <class Struct>
Struct ReadSettings(const Json& json, const JsonOrigin& origin) {
  Struct settings;
  internal::ReadFields(json, origin, FileKind::kSettings, &settings, internal::VisitFields<Struct>);
  return settings;
}

template <class Struct>
Struct ReadSettingsFile(const std::filesystem::path& file) {
  return ReadSettings<Struct>(ReadJsonFile(file), {file, ""});
}

// The resolved settings, every key present, in alphabetical order.
template <class Struct>
Json WriteSettings(Struct settings) {
  return internal::WriteFields(&settings, internal::VisitFields<Struct>);
}

// One line of `vitruvia explain`.
struct FieldDescription {
  std::string key;   // dotted path
  std::string type;  // number, integer, flag, text, file, choice, list, …
  std::string meaning, unit, range, default_value, origin, source;
};

// Every field of a struct, depth first, including those that apply only for some choices.
std::vector<FieldDescription> DescribeSettings(const std::string& prefix, void (*visit)(Fields&),
                                               FileKind kind = FileKind::kSettings);

template <class Struct>
std::vector<FieldDescription> Describe(const std::string& prefix) {
  return DescribeSettings(prefix, [](Fields& fields) {
    Struct settings;
    fields.Visit(settings);
  });
}

}  // namespace vitruvia
