#include "experiments/cli/compare_command.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "analysis/variant_comparison.h"
#include "core/error.h"
#include "core/files.h"
#include "core/message.h"
#include "experiments/cli/argument_checks.h"
#include "experiments/cli/experiment_folder.h"
#include "experiments/cli/problems.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

struct CompareArguments {
  fs::path first, second, output;
  std::string reference;
  std::vector<std::string> metrics;
  std::optional<double> detect;
};

constexpr double kPower = 0.8;

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
    const int pairs = row.comparison.difference.count;
    const std::string scenes = row.comparison.scenes > 1 ? ", " + UnitsText(row.comparison) : "";
    fmt::print("  {:<40} {:>12}  {:>34} {:>9}  {:>9}{}  {}{}\n", row.other,
               Printed(row.other_spread.mean, row.metric), DifferenceText(row), RelativeText(row),
               Counted(pairs, "pair"), scenes, VerdictText(row),
               row.unpaired == 0 ? "" : fmt::format("; {} runs without a partner", row.unpaired));
  }
  fmt::print("{}\n", MethodText(rows.size()));
}

// How many scenes, or seeds of a single scene, it takes to show a difference.
std::string NeededText(const VariantComparison& row, double difference) {
  const SampleSpread& units = row.comparison.unit_difference;
  const char* name = row.comparison.scenes > 1 ? "scenes" : "pairs";
  if (!(units.deviation > 0.0)) return fmt::format("unknown: the {} here do not differ", name);
  const double confidence = BootstrapSettings{}.confidence;
  return fmt::format(
      "{} {}", UnitsToShow(difference / row.metric.scale, units.deviation, confidence, kPower),
      name);
}

void PrintNeeded(const std::vector<VariantComparison>& rows, double difference) {
  fmt::print(
      "\nto show a difference of {:g} with a probability of {:.0f} % (before Holm's "
      "correction), it takes\n",
      difference, 1e2 * kPower);
  for (const VariantComparison& row : rows)
    fmt::print("  {:<40} {:<28} {}\n", row.other, Titled(row.metric), NeededText(row, difference));
}

struct TableFormat {
  const char* ending;
  std::string (*content)(const std::vector<VariantComparison>& rows);
};

constexpr std::array<TableFormat, 4> kTableFormats = {{
    {".tex",
     [](const auto& rows) { return "% needs \\usepackage{booktabs}\n" + ToLatex(ToText(rows)); }},
    {".csv", [](const auto& rows) { return ToCsv(rows); }},
    {".md", [](const auto& rows) { return ToMarkdown(ToText(rows)); }},
    {".json", [](const auto& rows) { return ToJson(rows).dump(2) + "\n"; }},
}};

// By the file's ending; null if there is none for it.
const TableFormat* WriterFor(const fs::path& file) {
  for (const TableFormat& format : kTableFormats) {
    if (file.extension() == format.ending) return &format;
  }
  return nullptr;
}

void WriteTable(const std::vector<VariantComparison>& rows, const fs::path& file) {
  if (!file.parent_path().empty()) MakeFolder(file.parent_path());
  WriteWholeFile(file, WriterFor(file)->content(rows));
}

ReportedExperiment ReadAndPrintProblems(const fs::path& folder) {
  ReportedExperiment experiment = ReadExperiment(folder);
  PrintProblems(experiment);
  return experiment;
}

void Compare(const CompareArguments& a) {
  if (!a.output.empty() && WriterFor(a.output) == nullptr) {
    throw ConfigError(
        fmt::format("compare: -o {}: expected a name that ends in .tex, .csv, .md or .json",
                    a.output.string()));
  }
  if (!a.second.empty() && !a.reference.empty())
    throw ConfigError("compare: --reference names a variant of one folder; got two folders");
  const ReportedExperiment first = ReadAndPrintProblems(ExperimentFolder(a.first, ""));
  const std::vector<VariantComparison> rows =
      a.second.empty()
          ? CompareVariants(first, a.reference, a.metrics)
          : CompareExperiments(first, ReadAndPrintProblems(ExperimentFolder(a.second, "")),
                               a.metrics);
  PrintTable(rows);
  if (a.detect) PrintNeeded(rows, *a.detect);
  if (a.output.empty()) return;
  WriteTable(rows, a.output);
  fmt::print("table: {}\n", a.output.string());
}

}  // namespace

void AddCompareCommand(CLI::App& app) {
  const auto a = std::make_shared<CompareArguments>();
  CLI::App* compare = app.add_subcommand(
      "compare", "Compare the variants of an experiment, or the same runs of two folders");
  compare->add_option("EXPERIMENT", a->first, "an experiment file, or the folder of its output")
      ->required();
  compare->add_option(
      "OTHER", a->second,
      "another experiment with the same runs; without it, the variants of EXPERIMENT are compared");
  compare->add_option("--reference", a->reference,
                      "the variant with which the others are compared; default: the one with all "
                      "swept settings at their defaults, or the first");
  compare->add_option("--metric", a->metrics,
                      "key of a metric (vitruvia explain); can be repeated");
  compare
      ->add_option("--detect", a->detect,
                   "print how many scenes are needed to detect a difference of this size, in the "
                   "metric's printed unit")
      ->check(NumberIn(1e-9, 1e9));
  compare->add_option("-o,--output", a->output,
                      "also write the table to this .tex, .csv, .md or .json file");
  compare->callback([a] { Compare(*a); });
}

}  // namespace vitruvia
