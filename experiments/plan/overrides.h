// Overrides of a config file: RFC 7386 merge patches, as variants have them.
#pragma once

#include <string>

#include "config/json_settings.h"

namespace vitruvia {

// The problem of the overrides under that key, or "". They must be an object without any null: a
// merge patch would remove a key that is null, and its default would be used unnoticed.
std::string OverridesProblem(const std::string& key, const Json& overrides);

}  // namespace vitruvia
