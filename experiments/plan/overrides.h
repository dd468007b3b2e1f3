// Overrides of a config file: RFC 7386 merge patches, as variants have them.
#pragma once

#include <string>

#include "config/json_settings.h"

namespace vitruvia {

// What is wrong with the overrides that stand under that key, or "". Expected is an object without
// null anywhere: a merge patch removes a key that is null, and its default would be used unnoticed.
std::string OverridesProblem(const std::string& key, const Json& overrides);

}  // namespace vitruvia
