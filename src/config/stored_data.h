// Stored data: the JSON files of our own formats, each described by one struct (settings.h) from
// which it is written and by which it is read. Common to all formats:
//
// Header. "format" and "version" come first. A file of another format or version is refused with
// one sentence; older versions that can still be read are first converted to the current one
// (Upgrade). A file with neither key has version 0: it was written before its format had a version.
//
// Keys. Every key must be present unless its description says optional; an unknown key, a wrong
// type or a value out of range is a DataError that names file, key path, value, what was expected
// and the nearest valid key. So a file is read completely or not at all.
//
// Absent values are left out of the file; they are never stored as zero:
//   an optional key            is not in the file where there is no value: NaN, an empty text, list
//                              or object in memory (readers also take null for a number)
//   an item of a list          is null in the file and NaN in memory where the description allows
//                              it, so that the other items keep their places
//
// Numbers that are not finite. JSON cannot represent them, and nlohmann_json would silently write
// null:
//   infinity                   is the text "Infinity" or "-Infinity", where the description allows
//                              it (a condition number, say); elsewhere writing it throws
//   NaN                        only means "absent", as above; elsewhere writing it throws
//
// The exception is std::invalid_argument naming key path and value: the program computed a value
// that it must not store. Finite numbers are read back bit for bit.
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

// A struct that is stored as a file has a member `static constexpr StoredFormat kFormat` and, if it
// can read older versions, `static void Upgrade(Json& file, int version)`.
struct StoredFormat {
  const char* name;    // "vitruvia-record"
  int version;         // the version that is written
  int oldest_version;  // the oldest version that is read
  const char* remedy;  // what the user should do with an older file, in the imperative
};

// The JSON of an object within a file, or of a file without a header.
template <class Struct>
Json StoredJson(Struct value) {
  return internal::WriteFields(&value, internal::VisitFields<Struct>);
}

// Throws the exception that writing would throw if a number cannot be stored; `where` precedes key
// path and value in its message.
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

// Reads a file without a header.
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
