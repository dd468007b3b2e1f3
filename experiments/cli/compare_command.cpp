#include "experiments/cli/compare_command.h"

#include <cmath>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "analysis/variant_comparison.h"
#include "core/error.h"
#include "core/files.h"
#include "experiments/cli/problems.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

struct CompareArguments {
  fs::path first, second, output;
  std::string reference;
  std::vector<std::string> metrics;
};

std::string DifferenceText(const VariantComparison& row) {
  const Interval& interval = row.comparison.interval;
  const std::string mean = PrintedSigned(row.comparison.difference.mean, row.metric);
  if (std::isinf(interval.low)) return mean;
  return fmt::format("{} [{}, {}]", mean, PrintedSigned(interval.low, row.metric),
                     PrintedSigned(interval.high, row.metric));
}

void PrintTable(const std::vector<VariantComparison>& rows) {
  std::string metric;
  for (const VariantComparison& row : rows) {
    if (row.metric.key != metric) {
      fmt::print("{}\n  {:<40} {:>12}\n", Titled(row.metric), row.reference,
                 Printed(row.reference_spread.mean, row.metric));
    }
    metric = row.metric.key;
    fmt::print("  {:<40} {:>12}  {:>34} {:>9}  {:>3} pairs  {}{}\n", row.other,
               Printed(row.other_spread.mean, row.metric), DifferenceText(row), RelativeText(row),
               row.comparison.difference.count, VerdictText(row),
               row.unpaired == 0 ? "" : fmt::format("; {} runs without a partner", row.unpaired));
  }
}

void WriteTable(const std::vector<VariantComparison>& rows, const fs::path& file) {
  if (!file.parent_path().empty()) MakeFolder(file.parent_path());
  WriteWholeFile(file, file.extension() == ".csv" ? ToCsv(rows) : ToJson(rows).dump(2) + "\n");
}

ReportedExperiment ReadAndPrintProblems(const fs::path& folder) {
  ReportedExperiment experiment = ReadExperiment(folder);
  PrintProblems(experiment);
  return experiment;
}

void Compare(const CompareArguments& a) {
  const std::string ending = a.output.extension().string();
  if (!a.output.empty() && ending != ".json" && ending != ".csv") {
    throw ConfigError(fmt::format("compare: -o {}: expected a name that ends in .json or .csv",
                                  a.output.string()));
  }
  if (!a.second.empty() && !a.reference.empty())
    throw ConfigError("compare: --reference names a variant of one folder; got two folders");
  const ReportedExperiment first = ReadAndPrintProblems(a.first);
  const std::vector<VariantComparison> rows =
      a.second.empty() ? CompareVariants(first, a.reference, a.metrics)
                       : CompareExperiments(first, ReadAndPrintProblems(a.second), a.metrics);
  PrintTable(rows);
  if (!a.output.empty()) WriteTable(rows, a.output);
}

}  // namespace

void AddCompareCommand(CLI::App& app) {
  const auto a = std::make_shared<CompareArguments>();
  CLI::App* compare = app.add_subcommand(
      "compare", "Compare the variants of an experiment, or the same runs of two folders");
  compare->add_option("DIR", a->first, "an experiment's folder")->required();
  compare->add_option(
      "OTHER", a->second,
      "another folder of the same runs; without it the variants of DIR are compared");
  compare->add_option("--reference", a->reference, "the variant that the others are compared with");
  compare->add_option("--metric", a->metrics,
                      "key of a metric (vitruvia explain); can be repeated");
  compare->add_option("-o,--output", a->output, "also write the table to this .json or .csv file");
  compare->callback([a] { Compare(*a); });
}

}  // namespace vitruvia
