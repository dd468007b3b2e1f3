#include "config/json_settings.h"

#include <algorithm>
#include <fstream>
#include <set>

#include <fmt/format.h>

#include "core/error.h"

namespace vitruvia {
namespace {

std::size_t EditDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row[b.size()];
}

}  // namespace

Json ReadJsonFile(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file)) {
    throw ConfigError(fmt::format("{}: cannot be opened; expected a JSON file", file.string()));
  }
  // nlohmann keeps the last of two equal keys silently; a config that says a thing twice is a
  // mistake.
  std::vector<std::set<std::string>> keys;
  const Json::parser_callback_t reject_repeated_keys = [&](int, Json::parse_event_t event,
                                                           Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key &&
        !keys.back().insert(parsed.get<std::string>()).second) {
      throw ConfigError(
          fmt::format("{}: the key {} stands twice in one object", file.string(), parsed.dump()));
    }
    return true;
  };
  try {
    return Json::parse(stream, reject_repeated_keys);
  } catch (const Json::exception& error) {
    throw ConfigError(fmt::format("{}: not valid JSON: {}", file.string(), error.what()));
  }
}

Json Merged(Json base, const Json& overrides) {
  base.merge_patch(overrides);
  return base;
}

std::string NearestWord(const std::string& word, const std::vector<std::string>& candidates) {
  std::string nearest;
  std::size_t best = word.size() / 2 + 1;  // farther than half the word is no likeness
  for (const std::string& candidate : candidates) {
    const std::size_t distance = EditDistance(word, candidate);
    if (distance < best) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

}  // namespace vitruvia
