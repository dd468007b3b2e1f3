// All kinds of config files and of stored data, for `vitruvia explain` and `vitruvia schema`.
#pragma once

#include <string>
#include <vector>

#include "config/json_settings.h"

namespace vitruvia {

struct ConfigKind {
  std::string name;     // name in `vitruvia schema` and in the keys of `explain`: "scene"
  std::string meaning;  // one line
  void (*visit)(Fields&);
  Json (*schema)();  // null: that of `visit`
  FileKind file_kind = FileKind::kSettings;
  // Path of the settings in a sweep: "scene" or "method.settings"; "" if they cannot be swept.
  std::string sweep_prefix{};
};
const std::vector<ConfigKind>& ConfigKinds();

// ConfigError naming the nearest kind if there is none of that name.
const ConfigKind& FindConfigKind(const std::string& name);

// The schema of a file of that kind.
Json SchemaOf(const ConfigKind& kind);

}  // namespace vitruvia
