// What a sweep changed, read from the runs' own configurations.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "records/run_record.h"

namespace vitruvia {

// The value that a resolved configuration has at a path such as "method.settings.fit.edge_px";
// null where it has none.
nlohmann::json ValueAt(const nlohmann::json& config, const std::string& path);

// Whether the run has the setting at the value that it has without the sweep.
bool IsAtDefault(const RunRecord& run, const SweptSetting& setting);
// Whether this is so for all settings but `except`.
bool AreOthersAtDefault(const RunRecord& run, const std::vector<SweptSetting>& sweep,
                        const SweptSetting* except);

// For axes and names: the path without "method.settings." and "scene.".
std::string ShortName(const SweptSetting& setting);
std::string PrintedValue(const nlohmann::json& value);

// A variant's name without what a sweep added: "default,fit.edge_px=2" is "default".
std::string UnsweptName(const std::string& variant);
// What a sweep added, "fit.edge_px=2"; the whole name where it added nothing.
std::string SweptPart(const std::string& variant);

}  // namespace vitruvia
