#include "methods/registry.h"

#include <functional>

#include "config/did_you_mean.h"
#include "config/settings_schema.h"
#include "core/error.h"
#include "methods/capsule_icp/capsule_icp.h"
#include "methods/dynamic/dynamic.h"
#include "methods/dynamic/skeleton_file.h"
#include "methods/external/external.h"
#include "methods/gmm_articulated/gmm_articulated.h"
#include "methods/realtime_scape/realtime_scape.h"
#include "methods/scape_regression/scape_regression.h"
#include "methods/sdf_parts/sdf_parts.h"
#include "methods/skeleton_driven/skeleton_driven.h"

namespace vitruvia {
namespace {

struct Entry {
  MethodInfo info;
  std::function<Json(const Json&, const JsonOrigin&)> resolve;
  std::function<std::unique_ptr<Tracker>(const Json&)> make;
};

template <class Method, class Settings>
Entry MakeEntry(const char* name, const char* description) {
  return {
      {name, description, VisitDefaults<Settings>},
      [](const Json& json, const JsonOrigin& origin) {
        return WriteSettings(ReadSettings<Settings>(json, origin));
      },
      [](const Json& json) {
        return std::make_unique<Method>(ReadSettings<Settings>(json, {"resolved settings", ""}));
      }};
}

const std::vector<Entry>& Entries() {
  static const std::vector<Entry> entries = {
      MakeEntry<realtime_scape::RealtimeScape, realtime_scape::Settings>(
          "realtime_scape", "paper A: LBS body of 17 bones, four-term energy, conjugate gradients"),
      MakeEntry<dynamic::Dynamic, dynamic::Settings>(
          "dynamic",
          "paper B: dual-quaternion joints, projective association, a warp for every vertex"),
      MakeEntry<capsule_icp::CapsuleIcp, capsule_icp::Settings>(
          "capsule_icp", "baseline: capsules fitted to the subject, articulated closest points"),
      MakeEntry<sdf_parts::SdfParts, sdf_parts::Settings>(
          "sdf_parts", "baseline: rigid parts with signed distance fields, after DART"),
      MakeEntry<gmm_articulated::GmmArticulated, gmm_articulated::Settings>(
          "gmm_articulated", "baseline: mixture of Gaussians with joints, after Ye & Yang"),
      MakeEntry<skeleton_driven::SkeletonDriven, skeleton_driven::Settings>(
          "skeleton_driven",
          "baseline of paper A: joints found in each frame move a rig with heat-diffusion weights"),
      MakeEntry<scape_regression::ScapeRegression, scape_regression::Settings>(
          "scape_regression",
          "baseline of paper A: SCAPE by regression, fitted to depth and contour, offline"),
      MakeEntry<external::External, external::Settings>(
          "external", "a tracker of your own: a program (src/methods/external/PROTOCOL.md)")};
  return entries;
}

// The frame of a method file; its settings are read by the method they belong to.
struct MethodFile {
  std::string method;
  Json settings = Json::object();

  void Describe(Fields& f) {
    f.Text("method", method,
           {.meaning = "name of a tracking method (vitruvia list)", .required = true});
    f.FreeJson("settings", settings,
               {.meaning = "the method's settings (vitruvia explain METHOD)"});
  }
};

const Entry& FindEntry(const std::string& name, const std::string& where) {
  std::vector<std::string> names;
  for (const Entry& entry : Entries()) {
    if (entry.info.name == name) return entry;
    names.push_back(entry.info.name);
  }
  throw ConfigError(fmt::format("{}: method: unknown method \"{}\";{} known: {}", where, name,
                                DidYouMean(name, names, " "), fmt::join(names, ", ")));
}

}  // namespace

const std::vector<MethodInfo>& Methods() {
  static const std::vector<MethodInfo> infos = [] {
    std::vector<MethodInfo> list;
    for (const Entry& entry : Entries()) list.push_back(entry.info);
    return list;
  }();
  return infos;
}

void VisitMethodFile(Fields& fields) { VisitDefaults<MethodFile>(fields); }

void VisitSkeletonFile(Fields& fields) { VisitDefaults<dynamic::SkeletonFile>(fields); }

Json MethodFileSchema() {
  Json schema = SettingsSchema(VisitMethodFile);
  std::vector<std::string> names;
  for (const MethodInfo& method : Methods()) {
    names.push_back(method.name);
    schema["allOf"].push_back(
        {{"if",
          {{"required", Json::array({"method"})},
           {"properties", {{"method", {{"const", method.name}}}}}}},
         {"then", {{"properties", {{"settings", SettingsSchema(method.visit_settings)}}}}}});
  }
  schema["properties"]["method"]["enum"] = names;
  schema["properties"]["method"].erase("default");
  return schema;
}

MethodConfig ReadMethodConfig(const Json& json, const JsonOrigin& origin) {
  const auto file = ReadSettings<MethodFile>(json, origin);
  const Entry& entry = FindEntry(file.method, origin.file.string());
  return {file.method, entry.resolve(file.settings, {origin.file, "settings"})};
}

std::unique_ptr<Tracker> MakeTracker(const MethodConfig& config) {
  return FindEntry(config.method, "resolved settings").make(config.settings);
}

}  // namespace vitruvia
