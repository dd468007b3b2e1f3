#include "experiments/kept_work.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/build_info.h"
#include "core/file_lock.h"
#include "core/files.h"
#include "core/hash.h"

namespace vitruvia {
namespace fs = std::filesystem;

namespace {

// Folders of data can hold gigabytes: their files are told apart by name, size and time.
void AddFolder(const fs::path& folder, Hash64& hash) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files.push_back(fmt::format("{} {} {}", entry.path().lexically_relative(folder).string(),
                                entry.file_size(),
                                entry.last_write_time().time_since_epoch().count()));
  }
  std::sort(files.begin(), files.end());
  for (const std::string& file : files) hash.Add(file);
}

void AddNamedFiles(const Json& json, Hash64& hash) {
  if (json.is_string()) {
    const fs::path file = json.get<std::string>();
    std::error_code not_a_file;  // texts of all kinds are asked
    if (fs::is_regular_file(file, not_a_file)) hash.AddFile(file);
    if (file.has_parent_path() && fs::is_directory(file, not_a_file)) AddFolder(file, hash);
  }
  if (json.is_structured()) {
    for (const Json& item : json) AddNamedFiles(item, hash);
  }
}

}  // namespace

std::string WorkKey(const Json& resolved) {
  Hash64 hash;
  hash.Add(GetBuildInfo().build_id).Add(resolved.dump());
  AddNamedFiles(resolved, hash);
  return hash.Hex();
}

KeptFolder::KeptFolder(const fs::path& cache, const std::string& name, const Json& resolved)
    : folder_(cache / fmt::format("{}-{}", name, Hash64().Add(resolved.dump()).Hex())),
      marker_(folder_.string() + ".key"),
      key_(WorkKey(resolved)) {}

bool KeptFolder::complete() const {
  return fs::is_directory(folder_) && fs::is_regular_file(marker_) &&
         ReadWholeFile(marker_) == key_;
}

void KeptFolder::Obtain(const std::function<void(const fs::path&)>& make) const {
  if (complete()) return;
  MakeFolder(folder_.parent_path());
  const FileLock lock = FileLock::Wait(folder_.string() + ".lock", LockKind::kExclusive);
  if (complete()) return;  // made while we waited
  RemoveUnfinished(folder_);
  make(folder_);
  WriteWholeFile(marker_, key_);
}

}  // namespace vitruvia
