// A cache of built folders: each is named after the settings it was built from and is used again
// only by the program that built it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "config/json_settings.h"

namespace vitruvia {

// The settings with every path that they name in one spelling, so that the same files give the same
// hash wherever the program was started: from the last folder called "configs" on, or else
// absolute.
Json WithPortablePaths(const Json& resolved);
// 16 hex digits of those settings.
std::string SettingsHash(const Json& resolved);

// A hash of everything that a result depends on: the settings, the content of every file that they
// name, and the program (its linked identity, which differs whenever its code does). Equal keys
// mean that building again would give the same result. For a folder that the settings name, the
// names, sizes and times of its files stand for their content.
std::string CacheKey(const Json& resolved);

class CachedFolder {
 public:
  // `cache`/NAME-SETTINGSHASH.
  CachedFolder(const std::filesystem::path& cache, const std::string& name, const Json& resolved);

  const std::filesystem::path& path() const { return folder_; }
  // Whether the folder is there, complete, and built under this key.
  bool complete() const;
  // Calls `build` unless the folder is complete. If several processes ask for the same folder at
  // the same time, one builds it and the others wait.
  void GetOrBuild(const std::function<void(const std::filesystem::path& folder)>& build) const;

 private:
  std::filesystem::path folder_, marker_;
  std::string key_;
};

}  // namespace vitruvia
