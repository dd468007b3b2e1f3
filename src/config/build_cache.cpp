#include "config/build_cache.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/build_info.h"
#include "core/error.h"
#include "core/file_lock.h"
#include "core/files.h"
#include "core/hash.h"

namespace vitruvia {
namespace fs = std::filesystem;

namespace {

// Whether a setting of this key names a folder of data.
bool NamesFolder(const std::string& key) { return key.ends_with("folder") || key == "sequence"; }

// Adds the names, sizes and times of a folder's files, which can be gigabytes.
void AddFolder(const fs::path& folder, Hash64& hash) {
  std::vector<std::string> files;
  std::error_code unreadable;
  fs::recursive_directory_iterator it(folder, unreadable), end;
  for (; !unreadable && it != end; it.increment(unreadable)) {
    std::error_code gone;
    if (!it->is_regular_file(gone)) continue;
    files.push_back(fmt::format("{} {} {}", it->path().lexically_relative(folder).string(),
                                it->file_size(gone),
                                it->last_write_time(gone).time_since_epoch().count()));
  }
  std::sort(files.begin(), files.end());
  for (const std::string& file : files) hash.Add(file);
}

bool NamesFile(const std::string& text) {
  std::error_code not_a_file;  // the text may be anything
  return fs::is_regular_file(text, not_a_file);
}

void AddNamedFiles(const std::string& key, const Json& json, Hash64& hash) {
  if (json.is_string()) {
    const auto text = json.get<std::string>();
    if (NamesFile(text)) hash.AddFile(text);
    if (NamesFolder(key)) AddFolder(text, hash);
  }
  if (json.is_structured()) {
    for (const auto& item : json.items()) AddNamedFiles(item.key(), item.value(), hash);
  }
}

std::string PortablePath(const fs::path& path) {
  const fs::path absolute = fs::absolute(path).lexically_normal();
  fs::path portable = absolute;
  for (auto part = absolute.begin(); part != absolute.end(); ++part) {
    if (*part != "configs") continue;
    portable = *part;
    for (auto below = std::next(part); below != absolute.end(); ++below) portable /= *below;
  }
  return portable.generic_string();
}

Json Portable(const std::string& key, const Json& json) {
  if (json.is_structured()) {
    Json portable = json;
    for (const auto& item : portable.items()) {
      item.value() = Portable(json.is_array() ? key : item.key(), item.value());
    }
    return portable;
  }
  if (!json.is_string()) return json;
  const auto text = json.get<std::string>();
  const bool names_place = !text.empty() && (NamesFile(text) || NamesFolder(key));
  return names_place ? Json(PortablePath(text)) : json;
}

}  // namespace

Json WithPortablePaths(const Json& resolved) { return Portable("", resolved); }

std::string SettingsHash(const Json& resolved) {
  return Hash64().Add(WithPortablePaths(resolved).dump()).Hex();
}

std::string CacheKey(const Json& resolved) {
  Hash64 hash;
  hash.Add(GetBuildInfo().build_id).Add(SettingsHash(resolved));
  AddNamedFiles("", resolved, hash);
  return hash.Hex();
}

CachedFolder::CachedFolder(const fs::path& cache, const std::string& name, const Json& resolved)
    : folder_(cache / fmt::format("{}-{}", name, SettingsHash(resolved))),
      marker_(folder_.string() + ".key"),
      key_(CacheKey(resolved)) {}

bool CachedFolder::complete() const {
  if (!fs::is_directory(folder_)) return false;
  try {
    return ReadWholeFile(marker_) == key_;
  } catch (const DataError&) {
    return false;  // not built yet, or being built at this moment
  }
}

void CachedFolder::GetOrBuild(const std::function<void(const fs::path&)>& build) const {
  if (complete()) return;
  MakeFolder(folder_.parent_path());
  const FileLock lock = FileLock::Wait(folder_.string() + ".lock", LockKind::kExclusive);
  if (complete()) return;  // built while this process waited
  RemoveUnfinished(folder_);
  fs::remove(marker_);  // otherwise an interrupted build would pass for a complete one
  build(folder_);
  WriteWholeFile(marker_, key_);
}

}  // namespace vitruvia
