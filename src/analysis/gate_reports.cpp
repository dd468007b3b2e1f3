#include "analysis/gate_reports.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/markup.h"
#include "metrics/catalogue.h"

namespace vitruvia {
namespace {

// A number with as many digits as make a difference visible.
std::string Digits(double value) { return fmt::format("{:.6g}", value); }

std::string ChangeInPercent(const Finding& finding) {
  if (finding.was == 0.0) return "from 0";
  return fmt::format("{:+.1f} %", 1e2 * (finding.is - finding.was) / std::abs(finding.was));
}

// The values of a finding in the unit that people read.
struct PrintedFinding {
  std::string was, is, limit, unit;
};

PrintedFinding PrintedNumbers(const Finding& finding) {
  double scale = 1.0;
  std::string unit = " × calibration";
  if (finding.kind == NumberKind::kAccuracy) {
    const Metric metric = FindMetric(finding.metric);
    scale = metric.scale;
    unit = metric.unit.empty() ? "" : " " + metric.unit;
  }
  return {Digits(scale * finding.was), Digits(scale * finding.is), Digits(scale * finding.limit),
          unit};
}

std::string BlameText(const Blame& blame) {
  if (blame.first_bad.empty()) return "";
  if (blame.last_good == blame.first_bad)
    return fmt::format("within {} (good and bad there)", blame.first_bad);
  return fmt::format("{} (good at {})", blame.first_bad,
                     blame.last_good.empty() ? "none known" : blame.last_good);
}

nlohmann::json FindingToJson(const Finding& finding) {
  nlohmann::json json = {{"run", finding.run},
                         {"kind", Name(finding.kind)},
                         {"metric", finding.metric},
                         {"was", finding.was},
                         {"is", finding.is},
                         {"limit", finding.limit},
                         {"change", Name(finding.change)}};
  if (finding.change == Change::kRegressed) {
    json["last_good"] = finding.blame.last_good;
    json["first_bad"] = finding.blame.first_bad;
  }
  return json;
}

std::string JunitCase(const std::string& run, const std::string& kind, const char* tag,
                      const std::string& message) {
  const std::string head =
      fmt::format("  <testcase classname=\"{}\" name=\"{}\"", Escaped(run), Escaped(kind));
  if (message.empty()) return head + "/>\n";
  return fmt::format("{}>\n    <{} message=\"{}\"/>\n  </testcase>\n", head, tag, Escaped(message));
}

std::string RegressionLines(const Judgement& judgement, const std::string& run, NumberKind kind) {
  std::string lines;
  for (const Finding* f : judgement.Regressions(kind)) {
    if (f->run != run) continue;
    const PrintedFinding numbers = PrintedNumbers(*f);
    lines += fmt::format("{}{}: was {}, is {}, limit {}{}; first bad {}", lines.empty() ? "" : "\n",
                         f->metric, numbers.was, numbers.is, numbers.limit, numbers.unit,
                         BlameText(f->blame));
  }
  return lines;
}

std::string FindingTable(const std::string& title, const std::vector<const Finding*>& findings) {
  if (findings.empty()) return "";
  std::string text = fmt::format(
      "## {}\n\n| run | metric | was | is | change | limit | first commit that could be to blame "
      "|\n|---|---|---|---|---|---|---|\n",
      title);
  for (const Finding* f : findings) {
    const PrintedFinding numbers = PrintedNumbers(*f);
    text += fmt::format("| `{}` | {} | {}{} | {} | {} | {} | {} |\n", f->run, f->metric,
                        numbers.was, numbers.unit, numbers.is, ChangeInPercent(*f), numbers.limit,
                        BlameText(f->blame));
  }
  return text + "\n";
}

std::string NameList(const std::string& title, const std::vector<std::string>& names) {
  if (names.empty()) return "";
  std::string text = fmt::format("## {}\n\n", title);
  for (const std::string& name : names) text += fmt::format("- `{}`\n", name);
  return text + "\n";
}

// On a busy machine slowdowns go unnoticed; who reads the summary has to know.
std::string NoiseText(const GateOccasion& occasion) {
  double noise = 0.0;
  for (const GatedRun& run : occasion.measured.runs) {
    const auto found = run.speed_noise.find(kWholeFrame);
    if (found != run.speed_noise.end()) noise = std::max(noise, found->second);
  }
  return fmt::format(" (here up to ±{:.0f} % of a frame's time{})", 1e2 * noise,
                     noise > occasion.tolerances.frame_time
                         ? ": the machine was busy, and slowdowns of that size go unseen"
                         : "");
}

std::string Runs(const std::vector<const Finding*>& findings) {
  std::set<std::string> runs;
  for (const Finding* finding : findings) runs.insert(finding->run);
  return fmt::format("{} number{} of {} run{}", findings.size(), findings.size() == 1 ? "" : "s",
                     runs.size(), runs.size() == 1 ? "" : "s");
}

}  // namespace

std::string Headline(const Judgement& judgement) {
  switch (judgement.Code()) {
    case ExitCode::kFailedRun:
      return fmt::format("failed: {} run{}", judgement.failures.size(),
                         judgement.failures.size() == 1 ? "" : "s");
    case ExitCode::kNothingMeasured:
      return judgement.findings.empty()
                 ? "nothing measured"
                 : fmt::format("{} of the baseline's runs and numbers not measured",
                               judgement.unmeasured.size());
    case ExitCode::kAccuracyRegressed:
      return "accuracy regressed: " + Runs(judgement.Regressions(NumberKind::kAccuracy));
    case ExitCode::kSpeedRegressed:
      return "speed regressed: " + Runs(judgement.Regressions(NumberKind::kSpeed));
    default:
      return "ok: " + Runs(judgement.OfChange(Change::kWithin)) + " within tolerance";
  }
}

nlohmann::json ToJson(const GateOccasion& occasion, const Judgement& judgement) {
  nlohmann::json findings = nlohmann::json::array(), runs = nlohmann::json::array();
  for (const Finding& finding : judgement.findings) findings.push_back(FindingToJson(finding));
  for (const GatedRun& run : occasion.measured.runs) runs.push_back(ToJson(run));
  return {{"name", occasion.name},
          {"date", occasion.date},
          {"commit", occasion.commit},
          {"cpu", occasion.cpu},
          {"verdict", Headline(judgement)},
          {"exit_code", static_cast<int>(judgement.Code())},
          {"baseline",
           {{"commit", occasion.baseline.commit},
            {"date", occasion.baseline.date},
            {"cpu", occasion.baseline.cpu}}},
          {"findings", findings},
          {"failures", judgement.failures},
          {"not_in_baseline", judgement.unknown},
          {"not_measured", judgement.unmeasured},
          {"runs", runs}};
}

std::string ToJunit(const GateOccasion& occasion, const Judgement& judgement) {
  std::string cases;
  int failures = 0, errors = 0, count = 0;
  for (const GatedRun& run : occasion.measured.runs) {
    for (const NumberKind kind : {NumberKind::kAccuracy, NumberKind::kSpeed}) {
      const std::string lines = RegressionLines(judgement, run.name(), kind);
      cases += JunitCase(run.name(), Name(kind), "failure", lines);
      failures += lines.empty() ? 0 : 1;
      ++count;
    }
  }
  const auto add_error = [&](const std::string& run, const std::string& message) {
    cases += JunitCase(run, "run", "error", message);
    ++errors;
    ++count;
  };
  for (const auto& [run, reason] : judgement.failures) add_error(run, reason);
  for (const std::string& name : judgement.unmeasured) add_error(name, "not measured");
  if (count == 0) add_error(occasion.name, "nothing measured");
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"{}\" tests=\"{}\" "
      "failures=\"{}\" errors=\"{}\" timestamp=\"{}\">\n{}</testsuite>\n",
      Escaped(occasion.name), count, failures, errors, occasion.date, cases);
}

std::string ToMarkdown(const GateOccasion& occasion, const Judgement& judgement) {
  std::string text = fmt::format(
      "# {}: {}\n\n{}, commit `{}`, on {}. Baseline: commit `{}`, {}, on {}.\n\nTolerances: "
      "accuracy {:g} %, time of a frame {:g} %, of a step {:g} % (of those with {:g} % of a frame "
      "and more). Times are multiples of the calibration kernel's, medians over the repeats; "
      "where these spread wider, that is tolerated too{}.\n\n",
      occasion.name, Headline(judgement), occasion.date, occasion.commit, occasion.cpu,
      occasion.baseline.commit, occasion.baseline.date, occasion.baseline.cpu,
      1e2 * occasion.tolerances.accuracy, 1e2 * occasion.tolerances.frame_time,
      1e2 * occasion.tolerances.step_time, 1e2 * occasion.tolerances.gated_step_share,
      NoiseText(occasion));
  if (!judgement.failures.empty()) {
    text += "## Failed\n\n";
    for (const auto& [run, reason] : judgement.failures)
      text += fmt::format("- `{}`: {}\n", run, reason);
    text += "\n";
  }
  text += NameList("Not measured", judgement.unmeasured);
  text += FindingTable("Accuracy regressed", judgement.Regressions(NumberKind::kAccuracy));
  text += FindingTable("Speed regressed", judgement.Regressions(NumberKind::kSpeed));
  text += FindingTable("Improved beyond tolerance", judgement.OfChange(Change::kImproved));
  text += NameList("Not in the baseline", judgement.unknown);
  return text + fmt::format("{} numbers are within tolerance.\n",
                            judgement.OfChange(Change::kWithin).size());
}

}  // namespace vitruvia
