#include "experiments/plan/overrides.h"

#include <fmt/format.h>

namespace vitruvia {
namespace {

std::string NullProblem(const std::string& key, const Json& value) {
  if (value.is_null())
    return fmt::format("{}: expected a value, got null; leave the key out to keep what is there",
                       key);
  if (!value.is_structured()) return "";
  for (const auto& item : value.items()) {
    const std::string inner = value.is_array() ? fmt::format("{}[{}]", key, item.key())
                                               : fmt::format("{}.{}", key, item.key());
    if (std::string problem = NullProblem(inner, item.value()); !problem.empty()) return problem;
  }
  return "";
}

}  // namespace

std::string OverridesProblem(const std::string& key, const Json& overrides) {
  if (!overrides.is_object())
    return fmt::format("{}: expected an object of overrides, got {}", key, overrides.dump());
  return NullProblem(key, overrides);
}

}  // namespace vitruvia
