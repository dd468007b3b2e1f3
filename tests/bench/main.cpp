// vitruvia_bench: runs the benchmarks and writes their results, or compares two of them (--help).
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/bench.h"
#include "config/json_settings.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/files.h"
#include "core/timer.h"

namespace vitruvia::bench {
namespace {
namespace fs = std::filesystem;

std::vector<std::string> GroupNames() {
  std::vector<std::string> names;
  for (const Group& group : Groups()) names.emplace_back(group.name);
  return names;
}

std::vector<Row> RowsOf(const Group& group) {
  const Stopwatch watch;
  std::vector<Row> rows = group.run();
  for (const Row& row : rows) {
    const std::string quartiles =
        std::isfinite(row.low) ? fmt::format("  [{:.4g}, {:.4g}]", row.low, row.high) : "";
    fmt::print("{:<48} {:>12.6g} {:<4}{}\n", row.name, row.value, row.unit, quartiles);
    if (!std::isfinite(row.value))
      throw RunError(fmt::format("{}: {} is not finite", group.name, row.name));
  }
  fmt::print("  ({}: {:.1f} s)\n", group.name, watch.ElapsedMs() / 1000.0);
  std::fflush(stdout);
  return rows;
}

Json Stored(const Row& row) {
  Json json = {{"name", row.name}, {"value", row.value}, {"unit", row.unit}};
  if (std::isfinite(row.low)) json["quartiles"] = {row.low, row.high};
  return json;
}

void RunGroups(const fs::path& folder, const std::vector<std::string>& chosen) {
  Json rows = Json::array();
  for (const Group& group : Groups()) {
    if (!chosen.empty() && std::find(chosen.begin(), chosen.end(), group.name) == chosen.end())
      continue;
    for (const Row& row : RowsOf(group)) rows.push_back(Stored(row));
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

int Main(int argc, char** argv) {
  CLI::App app(
      "Runs benchmarks, prints a line for each with its quartiles, and writes "
      "FOLDER/summary.json, whole or not at all; or compares two such files.",
      "vitruvia_bench");
  app.footer("Exit codes: 0 success, 2 bad arguments, 3 a damaged file, 4 not writable.");
  fs::path folder = "out/bench";
  std::vector<std::string> chosen;
  std::vector<fs::path> compared;
  app.add_option("FOLDER", folder, "where the results go")->capture_default_str();
  app.add_option("GROUP", chosen, "groups of benchmarks; all if none is named")
      ->check(CLI::IsMember(GroupNames()));
  app.add_option("--compare", compared, "two summary.json, measured in turn on one machine")
      ->expected(2)
      ->type_name("BEFORE AFTER");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool is_help = app.exit(error) == 0;
    return is_help ? 0 : static_cast<int>(ExitCode::kBadConfiguration);
  }
  if (compared.empty()) {
    RunGroups(folder, chosen);
  } else {
    fmt::print("{}", Comparison(compared[0], compared[1]));
  }
  return 0;
}

}  // namespace
}  // namespace vitruvia::bench

int main(int argc, char** argv) {
  try {
    return vitruvia::bench::Main(argc, argv);
  } catch (const vitruvia::Error& error) {
    fmt::print(stderr, "vitruvia_bench: {}\n", error.what());
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    fmt::print(stderr, "vitruvia_bench: internal error: {}\n", error.what());
    return 1;
  }
}
