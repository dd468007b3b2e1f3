// Work that is kept: a folder named after the settings it was made from, found again only by the
// build that made it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "config/json_settings.h"

namespace vitruvia {

// The settings with the files and folders that they name written alike, however the configs' path
// was spelt: from the last folder called "configs" on, or else as absolute paths. What work is
// called and found again by.
Json WithPortablePaths(const Json& resolved);
// Of those, 16 hex digits.
std::string SettingsHash(const Json& resolved);

// What a stored result depends on: settings, the content of every file that they name, and the
// program (its linked identity: a changed line of code is another program, committed or not). Two
// equal keys mean that doing the work again would change nothing but the clock. Of a folder that
// is named, names, sizes and times of its files stand for their content.
std::string WorkKey(const Json& resolved);

class KeptFolder {
 public:
  // `cache`/NAME-SETTINGSHASH.
  KeptFolder(const std::filesystem::path& cache, const std::string& name, const Json& resolved);

  const std::filesystem::path& path() const { return folder_; }
  // Whether the folder is there, whole, and of this very key.
  bool complete() const;
  // Calls `make` unless the folder is complete. Of several processes that want the same folder at
  // the same time one makes it; the others wait for it.
  void Obtain(const std::function<void(const std::filesystem::path& folder)>& make) const;

 private:
  std::filesystem::path folder_, marker_;
  std::string key_;
};

}  // namespace vitruvia
