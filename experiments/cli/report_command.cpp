#include "experiments/cli/report_command.h"

#include <array>
#include <filesystem>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

#include "core/error.h"
#include "experiments/cli/argument_checks.h"
#include "experiments/cli/experiment_folder.h"
#include "experiments/cli/problems.h"
#include "reports/pages/report.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kReportFooter =
    "With --width, --font-size or --format every figure is also written to paper/ in the\n"
    "experiment's folder: text in Liberation Sans (embedded in PDF), lines and text in proportion\n"
    "to the font size. Beside each figure lie NAME.tex, a figure environment with its caption, "
    "and\n"
    "NAME.txt, the caption and the runs behind each name of the legend.";

constexpr double kNarrowest_pt = 100.0, kWidest_pt = 3000.0;

struct ReportArguments {
  fs::path experiment, output;
  std::string width;
  std::optional<double> font_size;
  std::vector<std::string> formats;

  bool for_paper() const { return !width.empty() || font_size || !formats.empty(); }
};

// "84mm", "8.4cm", "3.3in" or "240pt" in points.
double Points(const std::string& text) {
  struct Unit {
    const char* name;
    double points;
  };
  constexpr std::array<Unit, 4> kUnits = {{{"mm", kPointsPerMillimeter},
                                           {"cm", 10.0 * kPointsPerMillimeter},
                                           {"in", 72.0},
                                           {"pt", 1.0}}};
  for (const Unit& unit : kUnits) {
    if (!text.ends_with(unit.name)) continue;
    std::size_t used = 0;
    double number = 0.0;
    const std::string digits = text.substr(0, text.size() - 2);
    try {
      number = std::stod(digits, &used);
    } catch (const std::exception&) {
      break;
    }
    const double points = number * unit.points;
    if (used == digits.size() && points >= kNarrowest_pt && points <= kWidest_pt) return points;
  }
  throw ConfigError(fmt::format(
      "report: --width {}: expected a length of {:g} to {:g} points such as 84mm, 8.4cm, 3.3in or "
      "240pt",
      text, kNarrowest_pt, kWidest_pt));
}

PaperFormat FormatOf(const ReportArguments& a) {
  PaperFormat format;
  if (!a.width.empty()) format.width_pt = Points(a.width);
  if (a.font_size) format.text_pt = *a.font_size;
  if (a.formats.empty()) return format;
  format.formats.clear();
  for (const std::string& name : a.formats) {
    for (const FileFormat candidate : {FileFormat::kSvg, FileFormat::kPdf, FileFormat::kPng}) {
      if (name == Name(candidate)) format.formats.push_back(candidate);
    }
  }
  return format;
}

void Report(const ReportArguments& a) {
  const PaperFormat format = FormatOf(a);  // reports its errors before anything is drawn
  const fs::path folder = ExperimentFolder(a.experiment, a.output);
  PrintProblems(ReadExperiment(folder));
  fmt::print("report: {}\n", WriteReport(folder).string());
  if (a.for_paper()) fmt::print("figures: {}\n", WritePaperFigures(folder, format).string());
}

}  // namespace

void AddReportCommand(CLI::App& app) {
  const auto a = std::make_shared<ReportArguments>();
  CLI::App* report =
      app.add_subcommand("report", "Draw an experiment's report again from its records");
  AddExperimentArgument(*report, a->experiment, a->output);
  report->add_option("--width", a->width, "width of the figures for a paper, such as 84mm; 84mm");
  report->add_option("--font-size", a->font_size, "size of their text in points; 8")
      ->check(NumberIn(3.0, 40.0));
  report->add_option("--format", a->formats, "their formats, such as pdf,svg,png; pdf")
      ->delimiter(',')
      ->check(CLI::IsMember({"pdf", "svg", "png"}));
  report->footer(kReportFooter);
  report->callback([a] { Report(*a); });
}

}  // namespace vitruvia
