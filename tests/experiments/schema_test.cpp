// The published JSON Schemas say what the strict reader and `explain` say.
#include <set>

#include <gmock/gmock.h>

#include "core/files.h"
#include "experiments/cli/config_kinds.h"
#include "experiments/command_line.h"

namespace vitruvia {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

// As much of JSON Schema as ours use. Every keyword that it does not know is a violation, so that
// nothing is believed to be checked that is not.
class SchemaCheck {
 public:
  std::vector<std::string> Violations(const Json& schema, const Json& value) {
    found_.clear();
    Check(schema, value, "");
    return found_;
  }

 private:
  void Check(const Json& schema, const Json& value, const std::string& path) {
    for (const auto& [keyword, rule] : schema.items()) {
      if (!Holds(keyword, rule, schema, value, path))
        found_.push_back(path + ": " + keyword + " " + rule.dump() + " against " + value.dump());
    }
  }

  bool Holds(const std::string& keyword, const Json& rule, const Json& schema, const Json& value,
             const std::string& path) {
    if (keyword == "type") return IsOfType(rule, value);
    if (keyword == "enum") return std::find(rule.begin(), rule.end(), value) != rule.end();
    if (keyword == "const") return value == rule;
    if (keyword == "minimum") return !value.is_number() || value >= rule;
    if (keyword == "maximum") return !value.is_number() || value <= rule;
    if (keyword == "minItems") return !value.is_array() || value.size() >= rule.get<std::size_t>();
    if (keyword == "maxItems") return !value.is_array() || value.size() <= rule.get<std::size_t>();
    if (keyword == "required") return HasAll(rule, value);
    if (keyword == "properties") return CheckProperties(rule, value, path);
    if (keyword == "items") return CheckItems(rule, value, path);
    if (keyword == "additionalProperties") return CheckOthers(rule, schema, value, path);
    if (keyword == "allOf") return CheckAll(rule, value, path);
    if (keyword == "if") return CheckIf(rule, schema.at("then"), value, path);
    return keyword == "then" || keyword == "$schema" || keyword == "title" ||
           keyword == "description" || keyword == "default";
  }

  static bool IsOfType(const std::string& type, const Json& value) {
    if (type == "number") return value.is_number();
    if (type == "integer") return value.is_number_integer();
    if (type == "boolean") return value.is_boolean();
    if (type == "string") return value.is_string();
    if (type == "array") return value.is_array();
    return type == "object" && value.is_object();
  }

  static bool HasAll(const Json& names, const Json& value) {
    return std::all_of(names.begin(), names.end(),
                       [&](const Json& name) { return value.contains(name.get<std::string>()); });
  }

  bool CheckOthers(const Json& rule, const Json& schema, const Json& value,
                   const std::string& path) {
    const Json named = schema.value("properties", Json::object());
    for (const auto& [key, item] : value.items()) {
      if (named.contains(key)) continue;
      if (rule == false) return false;
      Check(rule, item, path + "/" + key);
    }
    return true;
  }

  bool CheckProperties(const Json& rule, const Json& value, const std::string& path) {
    for (const auto& [key, schema] : rule.items()) {
      if (value.contains(key)) Check(schema, value.at(key), path + "/" + key);
    }
    return true;
  }

  bool CheckItems(const Json& rule, const Json& value, const std::string& path) {
    for (const Json& item : value) Check(rule, item, path + "/[]");
    return true;
  }

  bool CheckAll(const Json& rules, const Json& value, const std::string& path) {
    for (const Json& rule : rules) Check(rule, value, path);
    return true;
  }

  bool CheckIf(const Json& condition, const Json& then, const Json& value,
               const std::string& path) {
    if (SchemaCheck().Violations(condition, value).empty()) Check(then, value, path);
    return true;
  }

  std::vector<std::string> found_;
};

std::string KindOf(const fs::path& file, const Json& config) {
  const std::map<std::string, std::string> folders = {{"scenes", "scene"},
                                                      {"methods", "method"},
                                                      {"scans", "scan"},
                                                      {"learning", "learning"},
                                                      {"subjects", "subject"},
                                                      {"skeletons", "skeleton"},
                                                      {"motions", "motion"},
                                                      {"imports", "import_meshes"},
                                                      {"joints", "joint_learning"},
                                                      {"pose_regression", "pose_regression"}};
  const fs::path configs = fs::path(VITRUVIA_SOURCE_DIR) / "configs";
  const auto found = folders.find(file.lexically_relative(configs).begin()->string());
  if (found != folders.end()) return found->second;
  if (config.contains("experiments")) return "regression";
  if (config.contains("method")) return "method";
  if (config.contains("figures")) return "reproduction";
  return config.value("kind", "tracking") == "tracking" ? "experiment"
                                                        : config.at("kind").get<std::string>();
}

TEST(Schema, HoldsForEveryConfigFile) {
  int files = 0;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(VITRUVIA_SOURCE_DIR) / "configs")) {
    if (entry.path().extension() != ".json") continue;
    const Json config = ReadJsonFile(entry.path());
    const Json schema = SchemaOf(FindConfigKind(KindOf(entry.path(), config)));
    EXPECT_THAT(SchemaCheck().Violations(schema, config), IsEmpty()) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 40);
}

// Dotted keys as `explain` writes them.
void CollectKeys(const Json& schema, const std::string& path, std::set<std::string>& keys) {
  if (schema.contains("items")) return CollectKeys(schema.at("items"), path + "[]", keys);
  const Json others = schema.value("additionalProperties", Json(false));
  if (others.is_object()) {
    keys.erase(path);
    keys.insert(path + ".NAME");
    return CollectKeys(others, path + ".NAME", keys);
  }
  if (!schema.contains("properties")) return;
  for (const auto& [key, property] : schema.at("properties").items()) {
    if (key == "$schema") continue;
    keys.insert(path + "." + key);
    CollectKeys(property, path + "." + key, keys);
  }
}

// The header of stored data is described with all formats, in docs/stored_data.md.
TEST(Schema, HasTheKeysOfExplain) {
  for (const ConfigKind& kind : ConfigKinds()) {
    std::set<std::string> explained, published;
    for (const FieldDescription& field : DescribeSettings(kind.name, kind.visit))
      explained.insert(field.key);
    CollectKeys(SchemaOf(kind), kind.name, published);
    for (const char* key : {".format", ".version"}) published.erase(kind.name + std::string(key));
    EXPECT_EQ(published, explained) << kind.name;
    EXPECT_FALSE(published.empty()) << kind.name;
  }
}

TEST(Schema, RefusesWhatTheReaderRefuses) {
  const Json schema = SchemaOf(FindConfigKind("scene"));
  const Json scene = ReadJsonFile(SmallExperiment() / "scene.json");
  const auto violations = [&](void (*change)(Json&)) {
    Json changed = scene;
    change(changed);
    return SchemaCheck().Violations(schema, changed);
  };
  EXPECT_THAT(violations([](Json&) {}), IsEmpty());
  EXPECT_THAT(violations([](Json& s) { s["$schema"] = "scene.schema.json"; }), IsEmpty());
  EXPECT_EQ(violations([](Json& s) { s["framse"] = 3; }).size(), 1u);
  EXPECT_EQ(violations([](Json& s) { s["frames"] = 0; }).size(), 1u);
  EXPECT_EQ(violations([](Json& s) { s["frames"] = 1.5; }).size(), 1u);
  EXPECT_EQ(violations([](Json& s) { s["truth"]["skinning"] = "liner"; }).size(), 1u);
  EXPECT_EQ(violations([](Json& s) { s["view"]["position_m"] = {1.0, 2.0}; }).size(), 1u);
  const Json method = SchemaOf(FindConfigKind("method"));
  const auto of_method = [&](const Json& config) {
    return SchemaCheck().Violations(method, config).size();
  };
  EXPECT_EQ(of_method({{"method", "realtime_scape"}, {"settings", {{"axis_weight", 2}}}}), 0u);
  EXPECT_EQ(of_method({{"method", "dynamic"},
                       {"settings", {{"skeleton", "s.json"}, {"axis_weight", 2}}}}),
            1u);
  EXPECT_EQ(of_method({{"method", "static"}}), 1u);
  EXPECT_EQ(of_method({{"settings", Json::object()}}), 1u);
}

TEST(Schema, IsPrintedListedAndWritten) {
  const SmallExperiment files;
  const CallResult printed = CallVitruvia({"schema", "scan"});
  EXPECT_EQ(printed.code, static_cast<int>(ExitCode::kSuccess));
  EXPECT_EQ(Json::parse(printed.out), SchemaOf(FindConfigKind("scan")));
  EXPECT_THAT(CallVitruvia({"schema"}).out, HasSubstr("skeleton           a kinematic skeleton"));
  EXPECT_EQ(CallVitruvia({"schema", "-o", files.File("schemas")}).code,
            static_cast<int>(ExitCode::kSuccess));
  EXPECT_EQ(ReadJsonFile(files / "schemas/method.schema.json"), SchemaOf(FindConfigKind("method")));
  const CallResult refused = CallVitruvia({"schema", "seene"});
  EXPECT_EQ(refused.code, static_cast<int>(ExitCode::kBadConfiguration));
  EXPECT_THAT(refused.error, HasSubstr("no kind of file \"seene\"; did you mean \"scene\"?"));
}

TEST(Schema, ConfigsMayNameTheirs) {
  const SmallExperiment files;
  Json scene = ReadJsonFile(files / "scene.json");
  scene["$schema"] = "../scene.schema.json";
  files.Write("scene.json", scene);
  EXPECT_EQ(CallVitruvia({"synth", files.File("scene.json"), "-o", files.File("seq")}).code, 0);
  scene["view"]["$schema"] = "not here";
  files.Write("scene.json", scene);
  const CallResult refused =
      CallVitruvia({"synth", files.File("scene.json"), "-o", files.File("never")});
  EXPECT_EQ(refused.code, static_cast<int>(ExitCode::kBadConfiguration));
  EXPECT_THAT(refused.error, HasSubstr("view.$schema: unknown key"));
}

}  // namespace
}  // namespace vitruvia
