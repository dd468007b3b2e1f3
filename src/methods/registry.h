// All tracking methods by name. No other module depends on all of them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "config/json_settings.h"
#include "tracking/tracker.h"

namespace vitruvia {

struct MethodInfo {
  std::string name;                 // as method files say it: "realtime_scape"
  std::string description;          // one line
  void (*visit_settings)(Fields&);  // walks over default settings
};
const std::vector<MethodInfo>& Methods();

// A method file: { "method": NAME, "settings": { … } }. The resolved form has every setting.
struct MethodConfig {
  std::string method;
  Json settings;  // resolved
};

// Walks over the fields of a method file; those of a method's settings: MethodInfo.
void VisitMethodFile(Fields& fields);
// Walks over the fields of a file of configs/skeletons, which methods read.
void VisitSkeletonFile(Fields& fields);
// The JSON Schema of method files: settings are those of the method.
Json MethodFileSchema();

// ConfigError on an unknown method or bad settings.
MethodConfig ReadMethodConfig(const Json& json, const JsonOrigin& origin);

std::unique_ptr<Tracker> MakeTracker(const MethodConfig& config);

}  // namespace vitruvia
