// All tracking methods by name. Only this module knows them all.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/json_settings.h"
#include "tracking/tracker.h"

namespace vitruvia {

struct MethodInfo {
  std::string name;         // as method files say it: "realtime_scape"
  std::string description;  // one line
  std::vector<FieldDescription> settings;
};
const std::vector<MethodInfo>& Methods();

// A method file: { "method": NAME, "settings": { … } }. The resolved form has every setting.
struct MethodConfig {
  std::string method;
  Json settings;  // resolved
};

// ConfigError on an unknown method or bad settings.
MethodConfig ReadMethodConfig(const Json& json, const JsonOrigin& origin);

std::unique_ptr<Tracker> MakeTracker(const MethodConfig& config);

}  // namespace vitruvia
