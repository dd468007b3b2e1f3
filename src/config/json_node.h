// Reading of stored JSON: every value is fetched by a node that knows its file and key path, so a
// missing key or a wrong type is a DataError that names both.
#pragma once

#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/files.h"

namespace vitruvia {

inline constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

class JsonNode {
 public:
  JsonNode(const nlohmann::json& json, std::string where, std::string path = "")
      : json_(&json), where_(std::move(where)), path_(std::move(path)) {}

  const nlohmann::json& json() const { return *json_; }

  JsonNode At(const std::string& key) const {
    if (!json_->is_object()) Fail("expected an object");
    const auto found = json_->find(key);
    const std::string path = path_.empty() ? key : path_ + "." + key;
    if (found == json_->end()) throw DataError(fmt::format("{}: {}: key missing", where_, path));
    return {*found, where_, path};
  }

  std::string Text() const {
    if (!json_->is_string()) Fail("expected a text");
    return json_->get<std::string>();
  }
  double Number() const {
    if (!json_->is_number()) Fail("expected a number");
    return json_->get<double>();
  }
  double NumberOr(double value_of_null) const {
    return json_->is_null() ? value_of_null : Number();
  }
  int Integer() const {
    if (!json_->is_number_integer()) Fail("expected an integer");
    return json_->get<int>();
  }
  bool Flag() const {
    if (!json_->is_boolean()) Fail("expected true or false");
    return json_->get<bool>();
  }

  // What `parse` makes of each item of a list.
  template <class Parse>
  auto List(Parse parse) const {
    if (!json_->is_array()) Fail("expected a list");
    std::vector<decltype(parse(*this))> items;
    items.reserve(json_->size());
    for (std::size_t i = 0; i < json_->size(); ++i) {
      items.push_back(parse({(*json_)[i], where_, fmt::format("{}[{}]", path_, i)}));
    }
    return items;
  }
  std::vector<std::string> Texts() const {
    return List([](const JsonNode& item) { return item.Text(); });
  }
  std::vector<double> Numbers() const {
    return List([](const JsonNode& item) { return item.Number(); });
  }
  std::vector<double> NumbersOrNull() const {
    return List([](const JsonNode& item) { return item.NumberOr(kNoValue); });
  }

  // What `parse` makes of each member of an object, by key.
  template <class Parse>
  auto Map(Parse parse) const {
    if (!json_->is_object()) Fail("expected an object");
    std::map<std::string, decltype(parse(*this))> members;
    for (const auto& item : json_->items()) members.emplace(item.key(), parse(At(item.key())));
    return members;
  }

  [[noreturn]] void Fail(const std::string& reason) const {
    constexpr std::size_t kLongest = 60;
    std::string shown = json_->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    if (shown.size() > kLongest) shown = shown.substr(0, kLongest) + "…";
    throw DataError(fmt::format("{}: {}: {}, got {}", where_, path_, reason, shown));
  }

 private:
  const nlohmann::json* json_;
  std::string where_, path_;
};

// DataError naming the file if it is missing or no JSON.
inline nlohmann::json ReadStoredJson(const std::filesystem::path& file) {
  const std::string text = ReadWholeFile(file);
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    throw DataError(fmt::format("{}: not JSON: {}", file.string(), error.what()));
  }
}

// JSON knows no NaN and no infinity, and the library would write null for them without a word.
inline nlohmann::json Finite(double value, const std::string& name) {
  Require(std::isfinite(value), "{} = {}: only finite numbers can be stored", name, value);
  return value;
}
inline nlohmann::json FiniteOrNull(double value, const std::string& name) {
  return std::isnan(value) ? nlohmann::json(nullptr) : Finite(value, name);
}

}  // namespace vitruvia
