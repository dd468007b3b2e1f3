// Benchmarks: figures with a name and a unit, collected into one summary.json.
//
// Each group is a function in a file of its own, declared and listed in groups.cpp.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace vitruvia::bench {

struct Row {
  std::string name;  // snake_case, unique over all groups
  double value = 0.0;
  std::string unit;
};

struct Group {
  const char* name;
  std::vector<Row> (*run)();
};
std::span<const Group> Groups();

// Milliseconds that `work` takes: the median of so many runs (≥ 1).
double MedianMs(int runs, const std::function<void()>& work);
double Median(std::vector<double> values);

}  // namespace vitruvia::bench
