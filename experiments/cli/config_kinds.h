// All kinds of config files and of stored data: what `vitruvia explain` explains and `vitruvia
// schema` publishes.
#pragma once

#include <string>
#include <vector>

#include "config/json_settings.h"

namespace vitruvia {

struct ConfigKind {
  std::string name;     // as `vitruvia schema` and the keys of `explain` say it: "scene"
  std::string meaning;  // one line
  void (*visit)(Fields&);
  Json (*schema)();  // null: that of `visit`
  FileKind file_kind = FileKind::kSettings;
  // Where a sweep finds the settings: "scene" or "method.settings"; "" where it does not.
  std::string sweep_prefix{};
};
const std::vector<ConfigKind>& ConfigKinds();

// ConfigError naming the nearest kind if there is none of that name.
const ConfigKind& FindConfigKind(const std::string& name);

// Of a file of that kind.
Json SchemaOf(const ConfigKind& kind);

}  // namespace vitruvia
