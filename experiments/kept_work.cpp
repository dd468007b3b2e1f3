#include "experiments/kept_work.h"

#include <fmt/format.h>

#include "core/build_info.h"
#include "core/files.h"
#include "core/hash.h"

namespace vitruvia {
namespace fs = std::filesystem;

namespace {

void AddNamedFiles(const Json& json, Hash64& hash) {
  if (json.is_string()) {
    const fs::path file = json.get<std::string>();
    std::error_code not_a_file;  // texts of all kinds are asked
    if (fs::is_regular_file(file, not_a_file)) hash.AddFile(file);
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
      key_(WorkKey(resolved)) {
  MakeFolder(cache);
}

bool KeptFolder::complete() const {
  return fs::is_directory(folder_) && fs::is_regular_file(marker_) &&
         ReadWholeFile(marker_) == key_;
}

void KeptFolder::MarkComplete() const { WriteWholeFile(marker_, key_); }

}  // namespace vitruvia
