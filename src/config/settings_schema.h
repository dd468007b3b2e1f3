// JSON Schema (draft 2020-12) of settings, generated from the structs' descriptions (settings.h),
// so that an editor can complete a config file.
#pragma once

#include "config/json_settings.h"

namespace vitruvia {

// Walks over the fields of a default-constructed struct.
template <class Struct>
void VisitDefaults(Fields& fields) {
  Struct settings;
  fields.Visit(settings);
}

// The schema is more permissive than the strict reader: it allows fields that depend on a choice
// whatever the choice is, and does not check conditions between fields.
Json SettingsSchema(void (*visit)(Fields&), FileKind kind = FileKind::kSettings);

// The schema of a whole config file with those settings.
Json ConfigSchema(const std::string& title, Json settings);

// Key in which a config may name its schema, for editors; vitruvia ignores its value.
inline constexpr const char* kSchemaKey = "$schema";

}  // namespace vitruvia
