#include "experiments/run/run_times.h"

#include "core/error.h"
#include "math/statistics.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kTimedRecord = "record.json";

// Run folders below `folder`, without looking into them nor into shared work.
std::vector<fs::path> RunFolders(const fs::path& folder) {
  std::vector<fs::path> runs;
  std::error_code error;
  for (fs::recursive_directory_iterator it(folder, error), end; it != end; it.increment(error)) {
    if (!it->is_directory(error)) continue;
    const std::string name = it->path().filename().string();
    const bool is_run = fs::exists(it->path() / kTimedRecord);
    if (is_run) runs.push_back(it->path());
    if (is_run || name == "sequences" || name == "learned") it.disable_recursion_pending();
  }
  return runs;
}

}  // namespace

RunTimes::RunTimes(const fs::path& folder) {
  for (const fs::path& run : RunFolders(folder)) {
    try {
      const RunRecord record = ReadRunRecord(run.parent_path(), run.filename().string());
      const Json& how = record.provenance.value("run", Json::object());
      if (!how.contains("wall_s")) continue;
      seconds_[{record.method, record.summary.value("frames", 0)}].push_back(
          how.at("wall_s").get<double>());
    } catch (const DataError&) {
      continue;  // a damaged record is no reason not to plan
    }
  }
}

std::optional<double> RunTimes::Estimate(const PlannedRun& run) const {
  const auto found = seconds_.find({run.method, run.frames});
  if (found == seconds_.end()) return std::nullopt;
  return Quantile(found->second, 0.5);
}

}  // namespace vitruvia
