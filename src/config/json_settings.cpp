#include "config/json_settings.h"

#include <fstream>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "core/error.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;

// nlohmann keeps the last of two equal keys silently. Names the first key that an object holds
// twice; the text is known to be valid JSON.
[[noreturn]] void RefuseRepeatedKey(const fs::path& file, std::istream& text) {
  std::vector<std::set<std::string>> keys;
  const Json::parser_callback_t find = [&](int, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key &&
        !keys.back().insert(parsed.get<std::string>()).second) {
      throw ConfigError(
          fmt::format("{}: the key {} stands twice in one object", file.string(), parsed.dump()));
    }
    return true;
  };
  std::ignore = Json::parse(text, find);
  throw ConfigError(fmt::format("{}: a key stands twice in one object", file.string()));
}

}  // namespace

Json ReadJsonFile(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream || fs::is_directory(file)) {
    throw ConfigError(fmt::format("{}: cannot be opened; expected a JSON file", file.string()));
  }
  // An object with fewer members than keys holds a key twice, which is a mistake.
  std::vector<std::size_t> keys;
  bool repeated = false;
  const Json::parser_callback_t count_keys = [&](int, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys.push_back(0);
    if (event == Json::parse_event_t::key) ++keys.back();
    if (event == Json::parse_event_t::object_end) {
      repeated |= keys.back() != parsed.size();
      keys.pop_back();
    }
    return true;
  };
  Json json;
  try {
    json = Json::parse(stream, count_keys);
  } catch (const Json::exception& error) {
    throw ConfigError(fmt::format("{}: not valid JSON: {}", file.string(), error.what()));
  }
  if (repeated) {
    stream.clear();
    stream.seekg(0);
    RefuseRepeatedKey(file, stream);
  }
  return json;
}

Json Merged(Json base, const Json& overrides) {
  base.merge_patch(overrides);
  return base;
}

}  // namespace vitruvia
