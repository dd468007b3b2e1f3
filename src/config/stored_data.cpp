#include "config/stored_data.h"

#include <fmt/format.h>

#include "core/error.h"

namespace vitruvia::internal {
namespace {

constexpr const char* kFormatKey = "format";
constexpr const char* kVersionKey = "version";

}  // namespace

Json ReadJsonData(const std::filesystem::path& file) {
  try {
    return ReadJsonFile(file);
  } catch (const ConfigError& error) {
    throw DataError(error.what());
  }
}

int TakeHeader(Json& json, const std::filesystem::path& file, const StoredFormat& format) {
  const bool has_header =
      json.is_object() && (json.contains(kFormatKey) || json.contains(kVersionKey));
  if (!has_header && format.oldest_version == 0) return 0;
  const auto refuse = [&](const std::string& problem) {
    throw DataError(fmt::format("{}: {}", file.string(), problem));
  };
  if (!json.is_object()) refuse("expected an object");
  const auto name = json.find(kFormatKey), version = json.find(kVersionKey);
  if (name == json.end()) refuse(fmt::format("format: missing; expected \"{}\"", format.name));
  if (*name != format.name)
    refuse(fmt::format("format: expected \"{}\", got {}", format.name, name->dump()));
  if (version == json.end()) refuse(fmt::format("version: missing; expected {}", format.version));
  if (!version->is_number_integer())
    refuse(fmt::format("version: expected {}, got {}", format.version, version->dump()));
  const auto number = version->get<std::int64_t>();
  if (number > format.version) {
    refuse(fmt::format("version {}: a newer version of vitruvia wrote the file; this one reads {}",
                       number, format.version));
  }
  if (number < format.oldest_version) {
    refuse(
        fmt::format("version {}: an older version of vitruvia wrote the file; this one reads "
                    "{}; {}",
                    number, format.version, format.remedy));
  }
  json.erase(kFormatKey);
  json.erase(kVersionKey);
  return static_cast<int>(number);
}

void RefuseStored(const std::string& problem, int version, const StoredFormat& format) {
  if (version == format.version) throw DataError(problem);
  throw DataError(
      fmt::format("{} (version {} of the format, which an older version of vitruvia "
                  "wrote, is read only where it is complete; {})",
                  problem, version, format.remedy));
}

std::string StoredText(const nlohmann::ordered_json& content, const StoredFormat& format,
                       int indent) {
  nlohmann::ordered_json file = {{kFormatKey, format.name}, {kVersionKey, format.version}};
  file.update(content);
  return file.dump(indent) + "\n";
}

Json WithHeader(Json schema, const StoredFormat& format) {
  schema["properties"][kFormatKey] = {{"const", format.name}};
  schema["properties"][kVersionKey] = {{"const", format.version}};
  schema["required"].push_back(kFormatKey);
  schema["required"].push_back(kVersionKey);
  return schema;
}

}  // namespace vitruvia::internal
