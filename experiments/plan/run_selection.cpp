#include "experiments/plan/run_selection.h"

#include <algorithm>
#include <charconv>

#include "core/error.h"
#include "core/pattern.h"

namespace vitruvia {
namespace {

struct Shard {
  std::size_t index = 1, count = 1;
};

// All of the text as a whole number; 0 if it is none.
std::size_t WholeNumber(std::string_view text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? number : 0;
}

Shard ParseShard(const std::string& text) {
  if (text.empty()) return {};
  const std::size_t slash = std::min(text.find('/'), text.size());
  const std::string_view view = text;
  const Shard shard{WholeNumber(view.substr(0, slash)),
                    WholeNumber(view.substr(std::min(slash + 1, text.size())))};
  if (shard.index < 1 || shard.index > shard.count)
    throw ConfigError(fmt::format("--shard {}: expected i/n with 1 ≤ i ≤ n, such as 2/8", text));
  return shard;
}

std::vector<PlannedRun> Matching(const std::vector<PlannedRun>& runs, const std::string& only) {
  if (only.empty()) return runs;
  std::vector<PlannedRun> matching;
  for (const PlannedRun& run : runs) {
    const bool matches = MatchesPattern(only, run.run_id) || MatchesPattern(only, run.variant) ||
                         MatchesPattern(only, run.scene);
    if (matches) matching.push_back(run);
  }
  if (matching.empty())
    throw ConfigError(fmt::format(
        "--only {}: matches no run id, variant or scene of the {} runs; the first is {}", only,
        runs.size(), runs.empty() ? "none" : runs.front().run_id));
  return matching;
}

}  // namespace

std::vector<PlannedRun> SelectedRuns(const std::vector<PlannedRun>& runs,
                                     const RunSelection& selection) {
  const Shard shard = ParseShard(selection.shard);
  const std::vector<PlannedRun> matching = Matching(runs, selection.only);
  std::vector<PlannedRun> selected;
  for (std::size_t i = shard.index - 1; i < matching.size(); i += shard.count)
    selected.push_back(matching[i]);
  return selected;
}

}  // namespace vitruvia
