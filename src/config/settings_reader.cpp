#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "config/did_you_mean.h"
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

// Replaces a leading $NAME by the environment variable; other relative paths are relative to the
// config's folder.
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
    if (!std::filesystem::exists((config_file.parent_path() / value).lexically_normal())) {
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
  Reader(const Json& json, const JsonOrigin& origin, FileKind kind) : origin_(origin), kind_(kind) {
    if (!json.is_object()) {
      throw ConfigError(
          fmt::format("{}: expected an object, got {}", Where(origin.path), Shown(json)));
    }
    Open(json, "");
  }

  void Finish() {
    const Level& level = levels_.back();
    if (level.found < level.json->size()) RejectUnknownKeys(level);
    if (!missing_.empty()) {
      const auto& [path, meaning] = missing_.front();
      throw ConfigError(fmt::format("{}: missing; expected: {}", Where(path), meaning));
    }
    levels_.pop_back();
  }

  void Number(const char* key, double& value, const About& about) override {
    const Json* json = Find(key, about);
    if (json == nullptr) return;
    const bool is_absent = about.optional && json->is_null();
    value = is_absent ? kNoNumber : CheckedNumber(key, *json, about);
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
    value = json->get_ref<const std::string&>();
  }

  void File(const char* key, std::filesystem::path& value, const About& about) override {
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
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = CheckedNumber({key, i}, (*json)[i], about);
  }

  void FreeJson(const char* key, Json& value, const About& about) override {
    const Json* json = Find(key, about);
    if (json == nullptr) return;
    value = *json;
    if (about.infinite) RestoreInfinite(value);
  }

  void Texts(const char* key, std::vector<std::string>& values, const About& about) override {
    ReadList(key, values, about, [&](const Place& place, const Json& item) {
      if (!item.is_string()) Reject(place, item, "a text");
      return item.get<std::string>();
    });
  }

  void Files(const char* key, std::vector<std::filesystem::path>& values,
             const About& about) override {
    ReadList(key, values, about, [&](const Place& place, const Json& item) {
      if (!item.is_string()) Reject(place, item, "a path");
      return ResolvedPath(item.get<std::string>(), Where(PathOf(place)), origin_.file);
    });
  }

  void Integers(const char* key, std::vector<int>& values, const About& about) override {
    ReadList(key, values, about, [&](const Place& place, const Json& item) {
      return CheckedInteger(place, item, about);
    });
  }

  void NumberList(const char* key, std::vector<double>& values, const About& about) override {
    ReadList(key, values, about, [&](const Place& place, const Json& item) {
      return about.null_items && item.is_null() ? kNoNumber : CheckedNumber(place, item, about);
    });
  }

  void Flags(const char* key, std::vector<bool>& values, const About& about) override {
    ReadList(key, values, about, [&](const Place& place, const Json& item) {
      if (!item.is_boolean()) Reject(place, item, "true or false");
      return item.get<bool>();
    });
  }

 protected:
  void NamesAndNumbers(const char* key, NameAndNumberList& values, const About& about) override {
    ReadList(key, values, about, [&](const Place& place, const Json& item) {
      if (!item.is_array() || item.size() != 2 || !item[0].is_string() || !IsNumber(item[1], about))
        Reject(place, item, "a name and a number");
      return std::pair(item[0].get<std::string>(), CheckedNumber(place, item[1], about));
    });
  }

  void Triples(const char* key, std::vector<double>& coordinates, const About& about) override {
    const Json* json = FindList(key, about);
    if (json == nullptr) return;
    coordinates.clear();
    for (std::size_t i = 0; i < json->size(); ++i) {
      const Json& item = (*json)[i];
      if (about.null_items && item.is_null()) {
        coordinates.insert(coordinates.end(), 3, kNoNumber);
        continue;
      }
      const bool is_point = item.is_array() && item.size() == 3 && item[0].is_number() &&
                            item[1].is_number() && item[2].is_number();
      if (!is_point) Reject({key, i}, item, "three numbers");
      for (const Json& coordinate : item)
        coordinates.push_back(CheckedNumber({key, i}, coordinate, about));
    }
  }

  void ChoiceIndex(const char* key, std::size_t& index, std::span<const char* const> names,
                   const About& about) override {
    const Json* json = Find(key, about);
    if (json == nullptr) return;
    const auto expected = [&] { return "one of " + Quoted(names); };
    if (!json->is_string()) Reject(key, *json, expected());
    const auto& text = json->get_ref<const std::string&>();
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end())
      Reject(key, *json, expected() + DidYouMean(text, {names.begin(), names.end()}));
    index = static_cast<std::size_t>(found - names.begin());
  }

  bool BeginSection(const char* key, const About& about) override {
    const Json* json = Find(key, about);
    if (json == nullptr) return false;
    if (!json->is_object()) Reject(key, *json, "an object");
    Open(*json, key);
    return true;
  }
  void EndSection() override { Finish(); }

  bool BeginMap(const char* key, std::vector<std::string>& names, const About& about) override {
    if (!BeginSection(key, about)) return false;
    names.clear();
    for (const auto& item : levels_.back().json->items()) names.push_back(item.key());
    return true;
  }
  void EndMap() override { Finish(); }

  bool BeginList(const char* key, std::size_t& count, const About& about) override {
    const Json* json = FindList(key, about);
    if (json == nullptr) return false;
    count = json->size();
    lists_.emplace_back(json, key);
    return true;
  }

  void BeginItem(std::size_t index) override {
    const auto& [json, key] = lists_.back();
    const Json& item = (*json)[index];
    if (!item.is_object()) Reject({key, index}, item, "an object");
    Open(item, {key, index});
  }

  void EndItem() override { Finish(); }
  void EndList() override { lists_.pop_back(); }
  bool WantsProblems() const override { return true; }

  void ReportProblem(const std::string& problem) override {
    // A missing key is reported instead of a problem that may follow from it.
    if (!problem.empty() && missing_.empty())
      throw ConfigError(fmt::format("{}: {}", Where(PathOf(levels_.size())), problem));
  }

 private:
  static constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

  // A member of an object, or an item of a member that is a list. Converted to text only for
  // messages, because large files have many places.
  struct Place {
    static constexpr std::size_t kNoItem = static_cast<std::size_t>(-1);
    const char* key;
    std::size_t item = kNoItem;
    // NOLINTNEXTLINE(google-explicit-constructor): a key is a place
    Place(const char* of_key, std::size_t of_item = kNoItem) : key(of_key), item(of_item) {}
    std::string text() const { return item == kNoItem ? key : fmt::format("{}[{}]", key, item); }
  };

  struct Level {
    const Json* json;
    Place place;                     // in the level above
    std::vector<std::string> known;  // keys of the description, which may not outlive its calls
    std::size_t found;               // of them in the file
  };

  void Open(const Json& json, const Place& place) { levels_.push_back({&json, place, {}, 0}); }

  // Of the object at that depth.
  std::string PathOf(std::size_t depth) const {
    std::string path = origin_.path;
    for (std::size_t i = 1; i < depth; ++i) path = JoinedPath(path, levels_[i].place.text());
    return path;
  }
  std::string PathOf(const Place& place) const {
    return JoinedPath(PathOf(levels_.size()), place.text());
  }

  std::string Where(const std::string& path) const {
    return path.empty() ? origin_.file.string()
                        : fmt::format("{}: {}", origin_.file.string(), path);
  }

  [[noreturn]] void Reject(const Place& place, const Json& value,
                           const std::string& expected) const {
    throw ConfigError(
        fmt::format("{}: expected {}, got {}", Where(PathOf(place)), expected, Shown(value)));
  }

  bool Required(const About& about) const {
    return kind_ == FileKind::kStoredData ? !about.optional : about.required;
  }

  const Json* Find(const char* key, const About& about) {
    Level& level = levels_.back();
    level.known.push_back(key);
    const auto found = level.json->find(key);
    if (found != level.json->end()) {
      ++level.found;
      return &*found;
    }
    // A missing key is reported later, because an unknown (misspelt) key explains it better.
    if (Required(about)) missing_.emplace_back(PathOf(Place(key)), about.meaning);
    return nullptr;
  }

  const Json* FindList(const char* key, const About& about) {
    const Json* json = Find(key, about);
    if (json != nullptr && !json->is_array()) Reject(key, *json, "a list");
    return json;
  }

  template <class Value, class Parse>
  void ReadList(const char* key, std::vector<Value>& values, const About& about,
                const Parse& parse) {
    const Json* json = FindList(key, about);
    if (json == nullptr) return;
    values.clear();
    values.reserve(json->size());
    for (std::size_t i = 0; i < json->size(); ++i) values.push_back(parse({key, i}, (*json)[i]));
  }

  static bool IsInfinite(const Json& json) {
    return json == kInfinityText || json == kMinusInfinityText;
  }
  static bool IsNumber(const Json& json, const About& about) {
    return json.is_number() || (about.infinite && IsInfinite(json));
  }
  static double ValueOf(const Json& json) {
    if (json.is_number()) return json.get<double>();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return json == kInfinityText ? kInfinity : -kInfinity;
  }

  static void RestoreInfinite(Json& json) {
    if (IsInfinite(json)) json = ValueOf(json);
    if (!json.is_structured()) return;
    for (Json& member : json) RestoreInfinite(member);
  }

  double CheckedNumber(const Place& place, const Json& json, const About& about) const {
    if (!IsNumber(json, about)) Reject(place, json, Expected("a number", about));
    const double value = ValueOf(json);
    if (!(value >= about.min && value <= about.max))
      Reject(place, json, Expected("a number", about));
    return value;
  }

  int CheckedInteger(const Place& place, const Json& json, const About& about) const {
    if (!json.is_number()) Reject(place, json, Expected("a whole number", about));
    const double value = json.get<double>();
    if (std::trunc(value) != value || !(value >= std::max(about.min, -2147483648.0) &&
                                        value <= std::min(about.max, 2147483647.0))) {
      Reject(place, json, Expected("a whole number", about));
    }
    return static_cast<int>(value);
  }

  void RejectUnknownKeys(const Level& level) {
    std::vector<std::string> known = level.known;
    std::sort(known.begin(), known.end());
    known.erase(std::unique(known.begin(), known.end()), known.end());
    for (const auto& [key, value] : level.json->items()) {
      if (std::binary_search(known.begin(), known.end(), key)) continue;
      if (key == kSchemaKey && levels_.size() == 1 && value.is_string()) continue;
      throw ConfigError(fmt::format("{}: unknown key (value {});{} valid keys here: {}",
                                    Where(PathOf(Place(key.c_str()))), Shown(value),
                                    DidYouMean(key, known, " "), fmt::join(known, ", ")));
    }
  }

  JsonOrigin origin_;
  FileKind kind_;
  std::vector<Level> levels_;
  std::vector<std::pair<const Json*, const char*>> lists_;
  std::vector<std::pair<std::string, std::string>> missing_;
};

}  // namespace

namespace internal {

void ReadFields(const Json& json, const JsonOrigin& origin, FileKind kind, void* value,
                void (*visit)(Fields&, void*)) {
  Reader reader(json, origin, kind);
  visit(reader, value);
  reader.Finish();
}

}  // namespace internal
}  // namespace vitruvia
