// The settings that a sweep changed, read from the runs' configurations.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "records/run_record.h"

namespace vitruvia {

// The value of a resolved configuration at a path such as "method.settings.fit.edge_px"; null if it
// has none.
nlohmann::json ValueAt(const nlohmann::json& config, const std::string& path);

// Whether the run has the setting's value without the sweep.
bool IsAtDefault(const RunRecord& run, const SweptSetting& setting);
// The same for all settings but `except`.
bool AreOthersAtDefault(const RunRecord& run, const std::vector<SweptSetting>& sweep,
                        const SweptSetting* except);

// For axes and names: the path without "method.settings." and "scene.".
std::string ShortName(const SweptSetting& setting);
std::string PrintedValue(const nlohmann::json& value);

// A variant's name without what a sweep added: "default,fit.edge_px=2" is "default".
std::string UnsweptName(const std::string& variant);
// The part that a sweep added, "fit.edge_px=2"; the whole name if it added nothing.
std::string SweptPart(const std::string& variant);

}  // namespace vitruvia
