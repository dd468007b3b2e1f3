// vitruvia_bench: runs the benchmarks and writes their results to summary.json (see PrintHelp).
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "bench/bench.h"
#include "config/json_settings.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/files.h"
#include "core/timer.h"

namespace vitruvia::bench {
namespace {
namespace fs = std::filesystem;

std::vector<Group> Chosen(std::span<char*> names) {
  std::vector<Group> chosen;
  std::vector<std::string> known;
  for (const Group& group : Groups()) {
    known.emplace_back(group.name);
    const bool named = std::find(names.begin(), names.end(), known.back()) != names.end();
    if (names.empty() || named) chosen.push_back(group);
  }
  for (const char* name : names) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw ConfigError(fmt::format("no group of benchmarks is called '{}'; there are: {}", name,
                                    fmt::join(known, ", ")));
    }
  }
  return chosen;
}

constexpr const char* kDefaultFolder = "out/bench";

void PrintHelp() {
  fmt::print(
      "vitruvia_bench [FOLDER [GROUP...]]\n\n"
      "Runs benchmarks, prints a line for each, and writes FOLDER/summary.json, whole or not at "
      "all.\nFOLDER: {} if it is not given. GROUP: all if none is named; there are:\n",
      kDefaultFolder);
  for (const Group& group : Groups()) fmt::print("  {}\n", group.name);
  fmt::print("Exit codes: 0 success, 2 bad arguments, 4 not writable, 1 internal error.\n");
}

void Run(std::span<char*> arguments) {
  for (const std::string_view argument : arguments) {
    if (argument == "-h" || argument == "--help") return PrintHelp();
    if (argument.starts_with('-'))
      throw ConfigError(fmt::format("{}: no such option; --help says what there is", argument));
  }
  const fs::path folder = arguments.empty() ? kDefaultFolder : fs::path(arguments[0]);
  const std::vector<Group> groups = Chosen(arguments.empty() ? arguments : arguments.subspan(1));
  Json rows = Json::array();
  for (const Group& group : groups) {
    const Stopwatch watch;
    for (const Row& row : group.run()) {
      fmt::print("{:<48} {:>14.6g} {}\n", row.name, row.value, row.unit);
      if (!std::isfinite(row.value)) {
        throw RunError(fmt::format("{}: {} is not finite", group.name, row.name));
      }
      rows.push_back({{"name", row.name}, {"value", row.value}, {"unit", row.unit}});
    }
    fmt::print("  ({}: {:.1f} s)\n", group.name, watch.ElapsedMs() / 1000.0);
  }
  const BuildInfo& build = GetBuildInfo();
  const Json summary = {{"commit", build.commit},
                        {"compiler", build.compiler},
                        {"flags", build.flags},
                        {"rows", rows}};
  MakeFolder(folder);
  WriteWholeFile(folder / "summary.json", summary.dump(2) + "\n");
  fmt::print("{}\n", (folder / "summary.json").string());
}

}  // namespace

double Median(std::vector<double> values) {
  Require(!values.empty(), "Median: no values");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double MedianMs(int runs, const std::function<void()>& work) {
  std::vector<double> times_ms;
  for (int run = 0; run < runs; ++run) {
    const Stopwatch watch;
    work();
    times_ms.push_back(watch.ElapsedMs());
  }
  return Median(std::move(times_ms));
}

}  // namespace vitruvia::bench

int main(int argc, char** argv) {
  try {
    vitruvia::bench::Run(std::span(argv, static_cast<std::size_t>(argc)).subspan(1));
    return 0;
  } catch (const vitruvia::Error& error) {
    fmt::print(stderr, "vitruvia_bench: {}\n", error.what());
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    fmt::print(stderr, "vitruvia_bench: internal error: {}\n", error.what());
    return 1;
  }
}
