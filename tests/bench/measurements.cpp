#include <cmath>

#include <fmt/format.h>

#include "bench/bench.h"
#include "config/json_settings.h"
#include "core/error.h"
#include "core/timer.h"
#include "math/statistics.h"

namespace vitruvia::bench {
namespace {
namespace fs = std::filesystem;

std::vector<Row> ReadRows(const fs::path& file) {
  const Json summary = ReadJsonFile(file);
  std::vector<Row> rows;
  try {
    for (const Json& stored : summary.at("rows")) {
      Row row{stored.at("name"), stored.at("value"), stored.at("unit")};
      if (stored.contains("quartiles")) {
        row.low = stored["quartiles"].at(0);
        row.high = stored["quartiles"].at(1);
      }
      rows.push_back(std::move(row));
    }
  } catch (const Json::exception& error) {
    throw DataError(
        fmt::format("{}: no results of vitruvia_bench: {}", file.string(), error.what()));
  }
  return rows;
}

const Row* Find(const std::vector<Row>& rows, const std::string& name) {
  for (const Row& row : rows) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

// Where the quartiles of both overlap, a difference of the medians may be chance.
std::string Verdict(const Row& before, const Row& after) {
  if (!std::isfinite(before.low) || !std::isfinite(after.low)) return "one measurement";
  if (after.high < before.low) return "lower";
  if (after.low > before.high) return "higher";
  return "quartiles overlap";
}

}  // namespace

Row Spread(std::string name, std::vector<double> measured, std::string unit) {
  const double low = Quantile(measured, 0.25), high = Quantile(measured, 0.75);
  return {std::move(name), Median(std::move(measured)), std::move(unit), low, high};
}

double Median(std::vector<double> values) { return Quantile(std::move(values), 0.5); }

std::vector<double> TimesMs(int runs, const std::function<void()>& work) {
  std::vector<double> times_ms;
  for (int run = 0; run < runs; ++run) {
    const Stopwatch watch;
    work();
    times_ms.push_back(watch.ElapsedMs());
  }
  return times_ms;
}

Row TimeOf(std::string name, int runs, const std::function<void()>& work) {
  return Spread(std::move(name), TimesMs(runs, work), "ms");
}

double MedianMs(int runs, const std::function<void()>& work) { return Median(TimesMs(runs, work)); }

std::string Comparison(const fs::path& before_file, const fs::path& after_file) {
  const std::vector<Row> before = ReadRows(before_file), after = ReadRows(after_file);
  std::string table =
      fmt::format("{:<48} {:>12} {:>12} {:<4} {:>7}\n", "", "before", "after", "", "ratio");
  for (const Row& row : after) {
    const Row* const other = Find(before, row.name);
    if (other == nullptr) {
      table += fmt::format("{:<48} only after\n", row.name);
      continue;
    }
    table += fmt::format("{:<48} {:>12.5g} {:>12.5g} {:<4} {:>7.3f}  {}\n", row.name, other->value,
                         row.value, row.unit, row.value / other->value, Verdict(*other, row));
  }
  for (const Row& row : before) {
    if (Find(after, row.name) == nullptr) table += fmt::format("{:<48} only before\n", row.name);
  }
  return table;
}

}  // namespace vitruvia::bench
