#include <algorithm>
#include <cstdlib>
#include <set>

#include <fmt/format.h>

#include "config/json_settings.h"
#include "config/settings_schema.h"
#include "config/settings_text.h"
#include "core/error.h"

namespace vitruvia {
namespace {

std::string Shown(const Json& value) {
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  constexpr std::size_t kLongest = 60;
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "…";
  return text;
}

std::string Expected(const char* type, const About& about) {
  std::string text = type;
  if (const std::string range = Range(about); !range.empty()) text += " in " + range;
  if (*about.unit != '\0') text += fmt::format(" {}", about.unit);
  return text;
}

// Replaces a leading $NAME by the environment variable; relative paths hang on the config's folder.
std::filesystem::path ResolvedPath(const std::string& text, const std::string& where,
                                   const std::filesystem::path& config_file) {
  std::string expanded = text;
  if (!text.empty() && text[0] == '$') {
    const std::size_t end = std::min(text.find('/'), text.size());
    const std::string name = text.substr(1, end - 1);
    const char* value = std::getenv(name.c_str());
    if (value == nullptr || *value == '\0') {
      throw ConfigError(fmt::format("{}: {} needs the environment variable {}, which is not set",
                                    where, text, name));
    }
    if (!std::filesystem::exists(value)) {
      throw ConfigError(fmt::format(
          "{}: {} needs the environment variable {}, which names {}, and that is not there", where,
          text, name, value));
    }
    expanded = value + text.substr(end);
  }
  std::filesystem::path path(expanded);
  if (path.is_relative() && !path.empty()) path = config_file.parent_path() / path;
  return path.lexically_normal();
}

class Reader final : public Fields {
 public:
  Reader(const Json& json, const JsonOrigin& origin) : origin_(origin) {
    if (!json.is_object()) {
      throw ConfigError(
          fmt::format("{}: expected an object, got {}", Where(origin.path), Shown(json)));
    }
    levels_.push_back({&json, origin.path, {}});
  }

  void Finish() {
    RejectUnknownKeys(levels_.back());
    levels_.pop_back();
  }

  void Number(const char* key, double& value, const About& about) override {
    if (const Json* json = Find(key, about)) value = CheckedNumber(key, *json, about);
  }

  void Integer(const char* key, int& value, const About& about) override {
    if (const Json* json = Find(key, about)) value = CheckedInteger(key, *json, about);
  }

  void Flag(const char* key, bool& value, const About& about) override {
    const Json* json = Find(key, about);
    if (json == nullptr) return;
    if (!json->is_boolean()) Reject(key, *json, "true or false");
    value = json->get<bool>();
  }

  void Text(const char* key, std::string& value, const About& about) override {
    const Json* json = Find(key, about);
    if (json == nullptr) return;
    if (!json->is_string()) Reject(key, *json, "a text");
    value = json->get<std::string>();
  }

  void File(const char* key, std::filesystem::path& value, const About& about) override {
    std::string text;
    const Json* json = Find(key, about);
    if (json == nullptr) return;
    if (!json->is_string()) Reject(key, *json, "a path");
    value = ResolvedPath(json->get<std::string>(), Where(PathOf(key)), origin_.file);
  }

  void Numbers(const char* key, std::span<double> values, const About& about) override {
    const Json* json = Find(key, about);
    if (json == nullptr) return;
    if (!json->is_array() || json->size() != values.size()) {
      Reject(key, *json, fmt::format("a list of {} numbers", values.size()));
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = CheckedNumber(fmt::format("{}[{}]", key, i), (*json)[i], about);
    }
  }

  void FreeJson(const char* key, nlohmann::json& value, const About& about) override {
    if (const nlohmann::json* json = Find(key, about)) value = *json;
  }

  void Texts(const char* key, std::vector<std::string>& values, const About& about) override {
    const auto* json = FindList(key, about);
    if (json == nullptr) return;
    values.clear();
    for (std::size_t i = 0; i < json->size(); ++i) {
      const auto& item = (*json)[i];
      if (!item.is_string()) Reject(fmt::format("{}[{}]", key, i), item, "a text");
      values.push_back(item.get<std::string>());
    }
  }

  void Files(const char* key, std::vector<std::filesystem::path>& values,
             const About& about) override {
    std::vector<std::string> texts;
    if (FindList(key, about) == nullptr) return;
    Texts(key, texts, about);
    values.clear();
    for (const std::string& text : texts) {
      const std::string item = fmt::format("{}[{}]", key, values.size());
      values.push_back(ResolvedPath(text, Where(PathOf(item)), origin_.file));
    }
  }

  void Integers(const char* key, std::vector<int>& values, const About& about) override {
    const auto* json = FindList(key, about);
    if (json == nullptr) return;
    values.clear();
    for (std::size_t i = 0; i < json->size(); ++i) {
      values.push_back(CheckedInteger(fmt::format("{}[{}]", key, i), (*json)[i], about));
    }
  }

 protected:
  void ChoiceIndex(const char* key, std::size_t& index, std::span<const char* const> names,
                   const About& about) override {
    const nlohmann::json* json = Find(key, about);
    if (json == nullptr) return;
    const std::string expected = "one of " + Quoted(names);
    if (!json->is_string()) Reject(key, *json, expected);
    const std::string text = json->get<std::string>();
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end()) {
      const std::string nearest = NearestWord(text, {names.begin(), names.end()});
      Reject(key, *json,
             expected + (nearest.empty() ? "" : fmt::format("; did you mean \"{}\"?", nearest)));
    }
    index = static_cast<std::size_t>(found - names.begin());
  }

  bool BeginSection(const char* key, const About& about) override {
    const nlohmann::json* json = Find(key, about);
    if (json == nullptr) return false;
    if (!json->is_object()) Reject(key, *json, "an object");
    levels_.push_back({json, PathOf(key), {}});
    return true;
  }

  void EndSection() override { Finish(); }

  bool BeginList(const char* key, std::size_t& count, const About& about) override {
    const nlohmann::json* json = FindList(key, about);
    if (json == nullptr) return false;
    count = json->size();
    lists_.push_back({json, PathOf(key)});
    return true;
  }

  void BeginItem(std::size_t index) override {
    const auto& [json, path] = lists_.back();
    const nlohmann::json& item = (*json)[index];
    const std::string item_path = fmt::format("{}[{}]", path, index);
    if (!item.is_object()) {
      throw ConfigError(
          fmt::format("{}: expected an object, got {}", Where(item_path), Shown(item)));
    }
    levels_.push_back({&item, item_path, {}});
  }

  void EndItem() override { Finish(); }
  void EndList() override { lists_.pop_back(); }
  bool WantsProblems() const override { return true; }

  void ReportProblem(const std::string& problem) override {
    if (!problem.empty())
      throw ConfigError(fmt::format("{}: {}", Where(levels_.back().path), problem));
  }

 private:
  struct Level {
    const nlohmann::json* json;
    std::string path;
    std::set<std::string> known;
  };

  std::string Where(const std::string& path) const {
    return path.empty() ? origin_.file.string()
                        : fmt::format("{}: {}", origin_.file.string(), path);
  }

  std::string PathOf(const std::string& key) const { return JoinedPath(levels_.back().path, key); }

  [[noreturn]] void Reject(const std::string& key, const nlohmann::json& value,
                           const std::string& expected) const {
    throw ConfigError(
        fmt::format("{}: expected {}, got {}", Where(PathOf(key)), expected, Shown(value)));
  }

  const nlohmann::json* Find(const char* key, const About& about) {
    Level& level = levels_.back();
    level.known.insert(key);
    const auto found = level.json->find(key);
    if (found != level.json->end()) return &*found;
    // A misspelt key explains a missing one better than "missing" does.
    if (about.required) missing_.push_back({PathOf(key), about.meaning});
    return nullptr;
  }

  const nlohmann::json* FindList(const char* key, const About& about) {
    const nlohmann::json* json = Find(key, about);
    if (json != nullptr && !json->is_array()) Reject(key, *json, "a list");
    return json;
  }

  double CheckedNumber(const std::string& key, const nlohmann::json& json,
                       const About& about) const {
    if (!json.is_number()) Reject(key, json, Expected("a number", about));
    const double value = json.get<double>();
    if (!(value >= about.min && value <= about.max)) Reject(key, json, Expected("a number", about));
    return value;
  }

  int CheckedInteger(const std::string& key, const nlohmann::json& json, const About& about) const {
    if (!json.is_number_integer()) Reject(key, json, Expected("a whole number", about));
    const double value = json.get<double>();
    if (!(value >= std::max(about.min, -2147483648.0) &&
          value <= std::min(about.max, 2147483647.0))) {
      Reject(key, json, Expected("a whole number", about));
    }
    return json.get<int>();
  }

  void RejectUnknownKeys(const Level& level) {
    for (const auto& [key, value] : level.json->items()) {
      if (level.known.contains(key)) continue;
      if (key == kSchemaKey && level.path.empty() && value.is_string()) continue;
      const std::string nearest = NearestWord(key, {level.known.begin(), level.known.end()});
      std::string valid;
      for (const std::string& name : level.known) valid += (valid.empty() ? "" : ", ") + name;
      throw ConfigError(
          fmt::format("{}: unknown key (value {}); {}valid keys here: {}",
                      Where(JoinedPath(level.path, key)), Shown(value),
                      nearest.empty() ? "" : fmt::format("did you mean \"{}\"? ", nearest), valid));
    }
    if (!missing_.empty()) {
      const auto& [path, meaning] = missing_.front();
      throw ConfigError(fmt::format("{}: missing; expected: {}", Where(path), meaning));
    }
  }

  JsonOrigin origin_;
  std::vector<Level> levels_;
  std::vector<std::pair<const nlohmann::json*, std::string>> lists_;
  std::vector<std::pair<std::string, std::string>> missing_;
};

}  // namespace

namespace internal {

void ReadSettingsWith(const Json& json, const JsonOrigin& origin, void* settings,
                      void (*visit)(Fields&, void*)) {
  Reader reader(json, origin);
  visit(reader, settings);
  reader.Finish();
}

}  // namespace internal
}  // namespace vitruvia
