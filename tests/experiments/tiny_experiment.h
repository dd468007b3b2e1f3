// Config files of an experiment that takes a fraction of a second.
#pragma once

#include <filesystem>

#include "core/files.h"
#include "core/json_settings.h"
#include "support/temporary_folder.h"

namespace vitruvia {

// scene.json, method.json and experiment.json in a folder of the test's own.
class TinyExperiment {
 public:
  TinyExperiment() {
    const std::filesystem::path configs = std::filesystem::path(VITRUVIA_SOURCE_DIR) / "configs";
    Json scene = ReadJsonFile(configs / "scenes" / "small.json");
    scene["motion"]["file"] = (configs / "motions" / "arm_wave.json").string();
    Write("scene.json", scene);
    Write("method.json", {{"method", "realtime_scape"}});
    Write("experiment.json",
          {{"title", "Test"}, {"scenes", {"scene.json"}}, {"methods", {"method.json"}}});
  }

  std::string File(const std::string& name) const { return (folder_ / name).string(); }
  Json Read(const std::string& name) const { return ReadJsonFile(folder_ / name); }
  void Write(const std::string& name, const Json& json) const {
    WriteWholeFile(folder_ / name, json.dump());
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace vitruvia
