// Benchmarks: figures with a name and a unit, collected into one summary.json.
//
// Each group is a function in a file of its own, declared and listed in groups.cpp.
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace vitruvia::bench {

struct Row {
  std::string name;    // snake_case, unique over all groups
  double value = 0.0;  // a median where it was measured several times
  std::string unit;
  // Quartiles of the measurements; NaN where there is only one.
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
};

// The row of several measurements (≥ 1): their median and quartiles.
Row Spread(std::string name, std::vector<double> measured, std::string unit);
// The row of the milliseconds that `work` takes, carried out so many times.
Row TimeOf(std::string name, int runs, const std::function<void()>& work);

struct Group {
  const char* name;
  std::vector<Row> (*run)();
};
std::span<const Group> Groups();

double MedianMs(int runs, const std::function<void()>& work);
double Median(std::vector<double> values);

// What two summary.json hold of the same rows, as a table: both values, their ratio, and whether
// the quartiles lie apart. Rows that only one of them has are named. DataError on a file that is
// none.
std::string Comparison(const std::filesystem::path& before, const std::filesystem::path& after);

}  // namespace vitruvia::bench
