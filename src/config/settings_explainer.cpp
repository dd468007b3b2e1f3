#include <utility>

#include <fmt/format.h>

#include "config/json_settings.h"
#include "config/settings_text.h"

namespace vitruvia {
namespace {

class Explainer final : public Fields {
 public:
  Explainer(std::string prefix, FileKind kind) : kind_(kind) {
    prefixes_.push_back(std::move(prefix));
  }
  std::vector<FieldDescription> Take() { return std::move(lines_); }

  void Number(const char* key, double& value, const About& about) override {
    Add(key, "number", fmt::format("{:g}", value), about);
  }
  void Integer(const char* key, int& value, const About& about) override {
    Add(key, "whole number", fmt::format("{}", value), about);
  }
  void Flag(const char* key, bool& value, const About& about) override {
    Add(key, "true or false", value ? "true" : "false", about);
  }
  void Text(const char* key, std::string& value, const About& about) override {
    Add(key, "text", fmt::format("\"{}\"", value), about);
  }
  void File(const char* key, std::filesystem::path& value, const About& about) override {
    Add(key, "path", fmt::format("\"{}\"", value.string()), about);
  }
  void Numbers(const char* key, std::span<double> values, const About& about) override {
    Add(key, fmt::format("{} numbers", values.size()),
        nlohmann::json(std::vector<double>(values.begin(), values.end())).dump(), about);
  }
  void FreeJson(const char* key, nlohmann::json& value, const About& about) override {
    Add(key, value.is_array() ? "list" : "object", value.dump(), about);
  }
  void Texts(const char* key, std::vector<std::string>& values, const About& about) override {
    Add(key, "list of texts", nlohmann::json(values).dump(), about);
  }
  void Files(const char* key, std::vector<std::filesystem::path>&, const About& about) override {
    Add(key, "list of paths", "[]", about);
  }
  void Integers(const char* key, std::vector<int>& values, const About& about) override {
    Add(key, "list of whole numbers", nlohmann::json(values).dump(), about);
  }
  void NumberList(const char* key, std::vector<double>& values, const About& about) override {
    Add(key, about.null_items ? "list of numbers and nulls" : "list of numbers",
        nlohmann::json(values).dump(), about);
  }
  void Flags(const char* key, std::vector<bool>& values, const About& about) override {
    Add(key, "list of true or false", nlohmann::json(values).dump(), about);
  }
  bool Applies(bool) override { return true; }

 protected:
  void NamesAndNumbers(const char* key, NameAndNumberList&, const About& about) override {
    Add(key, "list of [name, number]", "[]", about);
  }
  void Triples(const char* key, std::vector<double>&, const About& about) override {
    Add(key, about.null_items ? "list of [x, y, z] and nulls" : "list of [x, y, z]", "[]", about);
  }
  bool BeginMap(const char* key, std::vector<std::string>& names, const About&) override {
    names = {"NAME"};  // one placeholder entry describes all
    prefixes_.push_back(JoinedPath(prefixes_.back(), key));
    return true;
  }
  void EndMap() override { prefixes_.pop_back(); }
  void ChoiceIndex(const char* key, std::size_t& index, std::span<const char* const> names,
                   const About& about) override {
    Add(key, "one of " + Quoted(names), fmt::format("\"{}\"", names[index]), about);
  }
  bool BeginSection(const char* key, const About& about) override {
    Add(key, "section", "", about);
    prefixes_.push_back(JoinedPath(prefixes_.back(), key));
    return true;
  }
  void EndSection() override { prefixes_.pop_back(); }
  bool BeginList(const char* key, std::size_t& count, const About& about) override {
    Add(key, "list of objects", "[]", about);
    prefixes_.push_back(JoinedPath(prefixes_.back(), key) + "[]");
    count = 1;
    return true;
  }
  void BeginItem(std::size_t) override {}
  void EndItem() override {}
  void EndList() override { prefixes_.pop_back(); }

 private:
  void Add(const char* key, std::string type, std::string value, const About& about) {
    if (about.infinite) type += ", \"Infinity\" or \"-Infinity\"";
    if (about.optional) type += ", optional";
    if (kind_ == FileKind::kStoredData) value.clear();  // stored data have no defaults
    lines_.push_back({JoinedPath(prefixes_.back(), key), std::move(type), about.meaning, about.unit,
                      Range(about), about.required ? "(required)" : std::move(value),
                      Name(about.origin), about.source});
  }

  FileKind kind_;
  std::vector<std::string> prefixes_;
  std::vector<FieldDescription> lines_;
};

}  // namespace

std::vector<FieldDescription> DescribeSettings(const std::string& prefix, void (*visit)(Fields&),
                                               FileKind kind) {
  Explainer explainer(prefix, kind);
  visit(explainer);
  return explainer.Take();
}

}  // namespace vitruvia
