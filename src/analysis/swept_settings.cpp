#include "analysis/swept_settings.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

namespace vitruvia {

nlohmann::json ValueAt(const nlohmann::json& config, const std::string& path) {
  const nlohmann::json* at = &config;
  std::istringstream keys(path);
  for (std::string key; std::getline(keys, key, '.');) {
    if (!at->is_object() || !at->contains(key)) return nullptr;
    at = &at->at(key);
  }
  return *at;
}

bool IsAtDefault(const RunRecord& run, const SweptSetting& setting) {
  return ValueAt(run.config, setting.path) == setting.default_value;
}

bool AreOthersAtDefault(const RunRecord& run, const std::vector<SweptSetting>& sweep,
                        const SweptSetting* except) {
  return std::all_of(sweep.begin(), sweep.end(), [&](const SweptSetting& setting) {
    return &setting == except || IsAtDefault(run, setting);
  });
}

std::string ShortName(const SweptSetting& setting) {
  for (const std::string prefix : {"method.settings.", "scene."}) {
    if (setting.path.starts_with(prefix)) return setting.path.substr(prefix.size());
  }
  return setting.path;
}

std::string PrintedValue(const nlohmann::json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{:.4g}", value.get<double>());
  return value.dump();
}

std::string UnsweptName(const std::string& variant) { return variant.substr(0, variant.find(',')); }

std::string SweptPart(const std::string& variant) {
  const std::size_t comma = variant.find(',');
  return comma == std::string::npos ? variant : variant.substr(comma + 1);
}

}  // namespace vitruvia
