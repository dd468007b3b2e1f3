#include "config/settings_schema.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "config/settings_text.h"

namespace vitruvia {
namespace {

constexpr const char* kDraft = "https://json-schema.org/draft/2020-12/schema";

enum class Conditional { kLeftOut, kIncluded };

// Text that an editor shows for a key.
std::string Tooltip(const About& about) {
  std::string text = about.meaning;
  if (*about.unit != '\0') text += fmt::format(" [{}]", about.unit);
  if (about.origin != Origin::kInput || *about.source != '\0') {
    text += fmt::format(" ({}{}{})", Name(about.origin), *about.source == '\0' ? "" : "; ",
                        about.source);
  }
  return text;
}

Json NumberType(const char* type, const About& about) {
  Json json = {{"type", type}};
  if (std::isfinite(about.min)) json["minimum"] = about.min;
  if (std::isfinite(about.max)) json["maximum"] = about.max;
  if (!about.infinite) return json;
  return {{"anyOf", {json, {{"enum", {kInfinityText, kMinusInfinityText}}}}}};
}

Json ListOf(Json item) { return {{"type", "array"}, {"items", std::move(item)}}; }

Json ItemType(Json item, const About& about) {
  if (!about.null_items) return item;
  return {{"anyOf", {std::move(item), {{"type", "null"}}}}};
}

Json EmptyObject() {
  return {{"type", "object"},
          {"properties", Json::object()},
          {"required", Json::array()},
          {"additionalProperties", false}};
}

// Conditional fields are either all visited or all skipped: the first walk finds the keys that a
// file may contain, the second those that it must contain.
class SchemaWriter final : public Fields {
 public:
  SchemaWriter(Conditional conditional, FileKind kind) : conditional_(conditional), kind_(kind) {
    levels_.push_back(EmptyObject());
  }
  Json Take() { return std::move(levels_.back()); }

  void Number(const char* key, double& value, const About& about) override {
    Json json = NumberType("number", about);
    if (std::isfinite(value)) json["default"] = value;
    Put(key, std::move(json), about);
  }
  void Integer(const char* key, int& value, const About& about) override {
    Json json = NumberType("integer", about);
    json["default"] = value;
    Put(key, std::move(json), about);
  }
  void Flag(const char* key, bool& value, const About& about) override {
    Put(key, {{"type", "boolean"}, {"default", value}}, about);
  }
  void Text(const char* key, std::string& value, const About& about) override {
    Put(key, {{"type", "string"}, {"default", value}}, about);
  }
  void File(const char* key, std::filesystem::path&, const About& about) override {
    Put(key, {{"type", "string"}}, about);
  }
  void Numbers(const char* key, std::span<double> values, const About& about) override {
    Json json = ListOf(NumberType("number", about));
    json["minItems"] = json["maxItems"] = values.size();
    json["default"] = std::vector<double>(values.begin(), values.end());
    Put(key, std::move(json), about);
  }
  void FreeJson(const char* key, nlohmann::json& value, const About& about) override {
    Json json = Json::object();
    if (value.is_object()) json["type"] = "object";
    Put(key, std::move(json), about);
  }
  void Texts(const char* key, std::vector<std::string>&, const About& about) override {
    Put(key, ListOf({{"type", "string"}}), about);
  }
  void Files(const char* key, std::vector<std::filesystem::path>&, const About& about) override {
    Put(key, ListOf({{"type", "string"}}), about);
  }
  void Integers(const char* key, std::vector<int>&, const About& about) override {
    Put(key, ListOf(NumberType("integer", about)), about);
  }
  void NumberList(const char* key, std::vector<double>&, const About& about) override {
    Put(key, ListOf(ItemType(NumberType("number", about), about)), about);
  }
  void Flags(const char* key, std::vector<bool>&, const About& about) override {
    Put(key, ListOf({{"type", "boolean"}}), about);
  }
  bool Applies(bool) override { return conditional_ == Conditional::kIncluded; }

 protected:
  void NamesAndNumbers(const char* key, NameAndNumberList&, const About& about) override {
    const Json pair = {{"type", "array"},
                       {"prefixItems", {{{"type", "string"}}, NumberType("number", about)}},
                       {"minItems", 2},
                       {"maxItems", 2}};
    Put(key, ListOf(pair), about);
  }
  void Triples(const char* key, std::vector<double>&, const About& about) override {
    Json point = ListOf(NumberType("number", about));
    point["minItems"] = point["maxItems"] = 3;
    Put(key, ListOf(ItemType(std::move(point), about)), about);
  }
  bool BeginMap(const char* key, std::vector<std::string>& names, const About& about) override {
    names = {kEveryName};
    return BeginSection(key, about);
  }
  void EndMap() override {
    Close([](const Json& section) {
      Json map = {{"type", "object"}};
      map["additionalProperties"] = section.at("properties").at(kEveryName);
      return map;
    });
  }
  void ChoiceIndex(const char* key, std::size_t& index, std::span<const char* const> names,
                   const About& about) override {
    Json json = {{"enum", std::vector<std::string>(names.begin(), names.end())}};
    json["default"] = names[index];
    Put(key, std::move(json), about);
  }
  bool BeginSection(const char* key, const About& about) override {
    open_.push_back({key, about});
    levels_.push_back(EmptyObject());
    return true;
  }
  void EndSection() override {
    Close([](Json section) { return section; });
  }
  bool BeginList(const char* key, std::size_t& count, const About& about) override {
    open_.push_back({key, about});
    levels_.push_back(EmptyObject());
    count = 1;
    return true;
  }
  void BeginItem(std::size_t) override {}
  void EndItem() override {}
  void EndList() override { Close(ListOf); }

 private:
  template <class Make>
  void Close(Make make) {
    Json level = std::move(levels_.back());
    levels_.pop_back();
    const auto [key, about] = open_.back();
    open_.pop_back();
    Put(key.c_str(), make(std::move(level)), about);
  }

  void Put(const char* key, Json schema, const About& about) {
    schema["description"] = Tooltip(about);
    levels_.back()["properties"][key] = std::move(schema);
    const bool required = kind_ == FileKind::kStoredData ? !about.optional : about.required;
    if (required) levels_.back()["required"].push_back(key);
  }

  static constexpr const char* kEveryName = "NAME";

  Conditional conditional_;
  FileKind kind_;
  std::vector<Json> levels_;
  std::vector<std::pair<std::string, About>> open_;
};

Json Walked(Conditional conditional, FileKind kind, void (*visit)(Fields&)) {
  SchemaWriter writer(conditional, kind);
  visit(writer);
  return writer.Take();
}

// Keeps only those required keys that the walk without conditional fields requires too.
void TakeRequired(Json& all, const Json& unconditional) {
  if (all.contains("required")) all["required"] = unconditional.at("required");
  if (all.contains("items")) {
    TakeRequired(all["items"], unconditional.at("items"));
    return;
  }
  if (!all.contains("properties")) return;
  for (auto& [key, schema] : all["properties"].items()) {
    const auto known = unconditional.at("properties").find(key);
    if (known != unconditional.at("properties").end()) TakeRequired(schema, *known);
  }
}

}  // namespace

Json SettingsSchema(void (*visit)(Fields&), FileKind kind) {
  Json schema = Walked(Conditional::kIncluded, kind, visit);
  TakeRequired(schema, Walked(Conditional::kLeftOut, kind, visit));
  return schema;
}

Json ConfigSchema(const std::string& title, Json settings) {
  settings["$schema"] = kDraft;
  settings["title"] = title;
  settings["properties"][kSchemaKey] = {{"type", "string"},
                                        {"description", "where this schema lies, for editors"}};
  return settings;
}

}  // namespace vitruvia
