// A cache of built folders. Each folder is named after the settings it was built from and is reused
// only by the program that built it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "config/json_settings.h"

namespace vitruvia {

// The settings with all their paths normalised, so that the same files give the same hash whatever
// the working directory: a path starts at its last folder called "configs", or is absolute if it
// has none.
Json WithPortablePaths(const Json& resolved);
// Hash of the settings with portable paths, 16 hex digits.
std::string SettingsHash(const Json& resolved);

// A hash of everything that a result depends on: the settings, the content of every file that they
// name, and the program (its build id, which changes with its code). With equal keys, building
// again would give the same result. For a folder in the settings, the names, sizes and modification
// times of its files are hashed instead of their content.
std::string CacheKey(const Json& resolved);

class CachedFolder {
 public:
  // `cache`/NAME-SETTINGSHASH.
  CachedFolder(const std::filesystem::path& cache, const std::string& name, const Json& resolved);

  const std::filesystem::path& path() const { return folder_; }
  // Whether the folder exists, is complete, and was built with this key.
  bool complete() const;
  // Calls `build` unless the folder is complete. If several processes ask for the same folder at
  // the same time, one builds it and the others wait.
  void GetOrBuild(const std::function<void(const std::filesystem::path& folder)>& build) const;

 private:
  std::filesystem::path folder_, marker_;
  std::string key_;
};

}  // namespace vitruvia
