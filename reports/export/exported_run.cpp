#include "reports/export/exported_run.h"

#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

void RequireFrames(const std::vector<int>& frames, int count, const std::string& run_id) {
  for (const int frame : frames) {
    if (frame >= 0 && frame < count) continue;
    throw ConfigError(
        fmt::format("{}: there is no frame {}: expected 0 … {}", run_id, frame, count - 1));
  }
}

}  // namespace

ExportedRun OpenForExport(const fs::path& experiment_folder, const std::string& run_id,
                          std::vector<int> frames) {
  RunRecord record = ReadRunRecord(experiment_folder, run_id);
  EstimateReader estimate(experiment_folder / run_id / "estimate");
  SequenceReader sequence(experiment_folder / record.sequence_folder);
  const auto count = static_cast<int>(estimate.frames().size());
  RequireFrames(frames, count, run_id);
  if (frames.empty()) {
    frames.resize(count);
    std::iota(frames.begin(), frames.end(), 0);
  }
  return {std::move(record), std::move(estimate), std::move(sequence), std::move(frames)};
}

}  // namespace vitruvia
