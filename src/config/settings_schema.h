// JSON Schema (draft 2020-12) of settings, made from the same description as everything else, so
// that an editor can complete a config file.
#pragma once

#include "config/json_settings.h"

namespace vitruvia {

// Walks over the fields of a default-constructed struct.
template <class Struct>
void VisitDefaults(Fields& fields) {
  Struct settings;
  fields.Visit(settings);
}

// Fields that depend on a choice are allowed whatever is chosen: the strict reader knows better,
// and checks what no single field can.
Json SettingsSchema(void (*visit)(Fields&), FileKind kind = FileKind::kSettings);

// The schema of a whole config file with those settings.
Json ConfigSchema(const std::string& title, Json settings);

// A config may say in this key where its schema lies; nothing else reads it.
inline constexpr const char* kSchemaKey = "$schema";

}  // namespace vitruvia
