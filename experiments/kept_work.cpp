#include "experiments/kept_work.h"

#include <fmt/format.h>

#include "core/build_info.h"
#include "core/files.h"
#include "core/hash.h"

namespace vitruvia {
namespace fs = std::filesystem;

std::string WorkKey(const Json& resolved, const std::vector<fs::path>& input_files) {
  Hash64 hash;
  hash.Add(GetBuildInfo().build_id).Add(resolved.dump());
  for (const fs::path& file : input_files) {
    if (fs::is_regular_file(file)) hash.AddFile(file);
  }
  return hash.Hex();
}

KeptFolder::KeptFolder(const fs::path& cache, const std::string& name, const Json& resolved,
                       const std::vector<fs::path>& input_files)
    : folder_(cache / fmt::format("{}-{}", name, Hash64().Add(resolved.dump()).Hex())),
      marker_(folder_.string() + ".key"),
      key_(WorkKey(resolved, input_files)) {
  MakeFolder(cache);
}

bool KeptFolder::complete() const {
  return fs::is_directory(folder_) && fs::is_regular_file(marker_) &&
         ReadWholeFile(marker_) == key_;
}

void KeptFolder::MarkComplete() const { WriteWholeFile(marker_, key_); }

}  // namespace vitruvia
