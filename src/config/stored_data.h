// Stored data: the JSON files of our own formats, each described by one struct (settings.h) from
// which it is written and by which it is read. What all of them have in common:
//
// Header. "format" and "version" come first. A file of another format or version is refused with
// one sentence; older versions that a format still reads are brought to the present one first
// (Upgrade). A file with neither key has version 0: it was written before its format had a version.
//
// Keys. Every key must be there unless its description says optional; an unknown key, a wrong type
// or a value out of range is a DataError that names file, key path, value, what was expected and
// the nearest valid key. So a file is read completely or not at all.
//
// Values that are absent are left out, and are never a zero:
//   an optional key            is not in the file where there is no value: NaN, an empty text, list
//                              or object in memory (readers also take null for a number)
//   an item of a list          is null in the file and NaN in memory where the description allows
//                              it, so that the other items keep their places
//
// Numbers that are not finite. JSON has none, and the library would write null for them silently:
//   infinity                   is the text "Infinity" or "-Infinity", where the description allows
//                              it (a condition number, say); elsewhere writing it throws
//   NaN                        only means "absent", as above; elsewhere writing it throws
//
// Throwing is std::invalid_argument naming key path and value: the program computed what it must
// not store. Numbers are written so that reading gives the same bits.
#pragma once

#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "config/json_settings.h"
#include "config/settings_schema.h"
#include "config/settings_text.h"
#include "core/absent.h"
#include "core/files.h"

namespace vitruvia {

// A struct of stored data that is a file of its own has `static constexpr StoredFormat kFormat`,
// and, if it reads older versions that differ, `static void Upgrade(Json& file, int version)`.
struct StoredFormat {
  const char* name;    // "vitruvia-record"
  int version;         // that is written
  int oldest_version;  // that is read
  const char* remedy;  // what to do with an older file, as a command to the user
};

// The JSON of an object within a file, or of a file without a header.
template <class Struct>
Json StoredJson(Struct value) {
  return internal::WriteFields(&value, internal::VisitFields<Struct>);
}

// Throws, as writing would, if a number cannot be stored; `where` goes before key path and value.
template <class Struct>
void RequireStorable(Struct value, const std::string& where) {
  try {
    StoredJson(std::move(value));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(where + error.what());
  }
}

template <class Struct>
Struct FromStoredJson(const Json& json, const JsonOrigin& origin) {
  Struct value;
  internal::ReadFields(json, origin, FileKind::kStoredData, &value, internal::VisitFields<Struct>);
  return value;
}

namespace internal {
Json ReadJsonData(const std::filesystem::path& file);  // DataError instead of ConfigError
// Checks and removes the header; returns the version.
int TakeHeader(Json& json, const std::filesystem::path& file, const StoredFormat& format);
[[noreturn]] void RefuseStored(const std::string& problem, int version, const StoredFormat& format);
std::string StoredText(const nlohmann::ordered_json& content, const StoredFormat& format,
                       int indent);
Json WithHeader(Json schema, const StoredFormat& format);
}  // namespace internal

template <class Struct>
Struct ReadStored(const std::filesystem::path& file) {
  constexpr StoredFormat format = Struct::kFormat;
  Json json = internal::ReadJsonData(file);
  const int version = internal::TakeHeader(json, file, format);
  if constexpr (requires { Struct::Upgrade(json, version); }) {
    if (version < format.version) Struct::Upgrade(json, version);
  }
  try {
    return FromStoredJson<Struct>(json, {file, ""});
  } catch (const ConfigError& error) {
    internal::RefuseStored(error.what(), version, format);
  }
}

// Of a file without a header.
template <class Struct>
Struct ReadStoredObject(const std::filesystem::path& file) {
  const Json json = internal::ReadJsonData(file);
  try {
    return FromStoredJson<Struct>(json, {file, ""});
  } catch (const ConfigError& error) {
    throw DataError(error.what());
  }
}

// A negative indent writes everything on one line.
template <class Struct>
void WriteStored(const std::filesystem::path& file, Struct value, int indent = 1) {
  WriteWholeFile(file,
                 internal::StoredText(internal::WriteFields(&value, internal::VisitFields<Struct>),
                                      Struct::kFormat, indent));
}

// For `vitruvia schema`.
template <class Struct>
Json StoredSchema() {
  return internal::WithHeader(SettingsSchema(VisitDefaults<Struct>, FileKind::kStoredData),
                              Struct::kFormat);
}

}  // namespace vitruvia
