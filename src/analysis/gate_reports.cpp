#include "analysis/gate_reports.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/markup.h"
#include "core/message.h"
#include "metrics/catalogue.h"

namespace vitruvia {
namespace {

// A number with enough digits to show a difference.
std::string Digits(double value) { return fmt::format("{:.6g}", value); }

// Of speed with the interval of the ratio, which decides.
std::string ChangeInPercent(const GateFinding& finding) {
  const auto percent = [](double ratio) { return fmt::format("{:+.1f} %", 1e2 * (ratio - 1.0)); };
  if (finding.kind == NumberKind::kSpeed) {
    return fmt::format("{} ({} … {})", percent(finding.is / finding.was),
                       percent(finding.ratio.low), percent(finding.ratio.high));
  }
  if (finding.was == 0.0) return "from 0";
  return fmt::format("{:+.1f} %", 1e2 * (finding.is - finding.was) / std::abs(finding.was));
}

// The values of a finding in printed units.
struct PrintedFinding {
  std::string was, is, limit, unit;
};

PrintedFinding PrintedNumbers(const GateFinding& finding) {
  double scale = 1.0;
  std::string unit = " ms";
  if (finding.kind == NumberKind::kAccuracy) {
    const Metric metric = FindMetric(finding.metric);
    scale = metric.scale;
    unit = metric.unit.empty() ? "" : " " + metric.unit;
  }
  return {Digits(scale * finding.was), Digits(scale * finding.is), Digits(scale * finding.limit),
          unit};
}

std::string BlameText(const GateFinding& finding) {
  const Blame& blame = finding.blame;
  if (blame.first_bad.empty()) {
    const bool may_be_the_settings =
        finding.kind == NumberKind::kAccuracy && finding.change == Change::kRegressed;
    return may_be_the_settings ? "none: the settings differ" : "";
  }
  if (blame.last_good == blame.first_bad)
    return fmt::format("within {} (good and bad there)", blame.first_bad);
  return fmt::format("{} (good at {})", blame.first_bad,
                     blame.last_good.empty() ? "none known" : blame.last_good);
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
  for (const GateFinding* f : judgement.Regressions(kind)) {
    if (f->run != run) continue;
    const PrintedFinding numbers = PrintedNumbers(*f);
    lines += fmt::format("{}{}: was {}, is {}, limit {}{}", lines.empty() ? "" : "\n", f->metric,
                         numbers.was, numbers.is, numbers.limit, numbers.unit);
    if (const std::string blame = BlameText(*f); !blame.empty()) lines += "; first bad " + blame;
  }
  return lines;
}

std::string FindingTable(const std::string& title,
                         const std::vector<const GateFinding*>& findings) {
  if (findings.empty()) return "";
  std::string text = fmt::format(
      "## {}\n\n| run | metric | was | is | change | limit | first commit that could be to blame "
      "|\n|---|---|---|---|---|---|---|\n",
      title);
  for (const GateFinding* f : findings) {
    const PrintedFinding numbers = PrintedNumbers(*f);
    text +=
        fmt::format("| `{}` | {} | {}{} | {} | {} | {} | {} |\n", f->run, f->metric, numbers.was,
                    numbers.unit, numbers.is, ChangeInPercent(*f), numbers.limit, BlameText(*f));
  }
  return text + "\n";
}

std::string NameList(const std::string& title, const std::vector<std::string>& names) {
  if (names.empty()) return "";
  std::string text = fmt::format("## {}\n\n", title);
  for (const std::string& name : names) text += fmt::format("- `{}`\n", name);
  return text + "\n";
}

std::string SettingsList(const Judgement& judgement) {
  if (judgement.changed_settings.empty()) return "";
  std::string text = "## Settings that differ from the baseline's\n\n";
  for (const auto& [run, changed] : judgement.changed_settings)
    text += fmt::format("- `{}`: {}\n", run, fmt::join(changed, "; "));
  return text + "\n";
}

std::string SpeedText(const GateOccasion& occasion, const Judgement& judgement) {
  if (!judgement.speed_not_judged.empty()) {
    return fmt::format("Speed not judged: {}.", judgement.speed_not_judged);
  }
  return fmt::format(
      "Times are those of this program and of the baseline's program (commit `{}`), run in turn on "
      "this machine; a change is called only if the {:g} % interval of the median ratio of its "
      "pairs lies outside the tolerance.",
      occasion.reference.commit, 1e2 * occasion.tolerances.confidence);
}

std::string Runs(const std::vector<const GateFinding*>& findings) {
  std::set<std::string> runs;
  for (const GateFinding* finding : findings) runs.insert(finding->run);
  return Counted(findings.size(), "number") + " of " + Counted(runs.size(), "run");
}

}  // namespace

std::string Headline(const Judgement& judgement) {
  switch (judgement.Code()) {
    case ExitCode::kFailedRun:
      return "failed: " + Counted(judgement.failures.size(), "run");
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
      return "ok: " + Runs(judgement.OfChange(Change::kWithin)) + " within tolerance" +
             (judgement.speed_not_judged.empty()
                  ? ""
                  : "; speed not judged: " + judgement.speed_not_judged);
  }
}

void RegressionFile::BaselineEntry::Describe(Fields& f) {
  f.Text("commit", commit, {.meaning = "commit of the program at the baseline's last renewal"});
  f.Text("date", date, {.meaning = "date of the baseline's last renewal"});
  f.Text("cpu", cpu, {.meaning = "CPU of the baseline's last renewal"});
}

void RegressionFile::FindingEntry::Describe(Fields& f) {
  f.Text("run", run, {.meaning = "experiment: variant.scene.method.seed"});
  f.Choice("kind", kind,
           {{Name(NumberKind::kAccuracy), NumberKind::kAccuracy},
            {Name(NumberKind::kSpeed), NumberKind::kSpeed}},
           {.meaning = "kind of number"});
  f.Text("metric", metric, {.meaning = "metric, or what was timed"});
  f.Number("was", was, {.meaning = "value in the baseline", .infinite = true});
  f.Number("is", is, {.meaning = "measured value", .infinite = true});
  f.Number("limit", limit, {.meaning = "worst value that would have passed", .infinite = true});
  f.Number("ratio_low", ratio.low,
           {.meaning = "lower end of the interval of the time's ratio; only of speed",
            .optional = true,
            .infinite = true});
  f.Number("ratio_high", ratio.high,
           {.meaning = "upper end of the interval of the time's ratio; only of speed",
            .optional = true,
            .infinite = true});
  f.Choice("change", change,
           {{Name(Change::kWithin), Change::kWithin},
            {Name(Change::kImproved), Change::kImproved},
            {Name(Change::kRegressed), Change::kRegressed}},
           {.meaning = "verdict on the number"});
  f.Text("last_good", blame.last_good,
         {.meaning = "last commit at which the number was good; only of a regression",
          .optional = true});
  f.Text("first_bad", blame.first_bad,
         {.meaning = "first commit at which the number was bad; only of a regression",
          .optional = true});
}

void RegressionFile::Describe(Fields& f) {
  f.Text("name", name, {.meaning = "title of the gate"});
  f.Text("date", date, {.meaning = "when the gate measured"});
  f.Text("commit", commit, {.meaning = "commit of the program that was measured"});
  f.Text("cpu", cpu, {.meaning = "CPU on which the gate measured"});
  f.Text("verdict", verdict, {.meaning = "verdict in one sentence"});
  f.Integer("exit_code", exit_code, {.meaning = "exit code of the gate"});
  f.Text("speed_not_judged", speed_not_judged,
         {.meaning = "why no time was compared; absent if times were", .optional = true});
  f.Section("baseline", baseline, {.meaning = "baseline that was compared with"});
  f.List("findings", findings, {.meaning = "every number that was compared with the baseline"});
  f.Map("failures", failures, {.meaning = "run → why it failed"});
  f.Map("changed_settings", changed_settings,
        {.meaning = "run → settings that differ from the baseline's: key: was → is",
         .optional = true});
  f.Texts("not_in_baseline", not_in_baseline,
          {.meaning = "runs and numbers that the baseline does not hold"});
  f.Texts("not_measured", not_measured,
          {.meaning = "runs and numbers of the baseline that were not measured"});
  f.List("runs", runs, {.meaning = "numbers that were measured"});
}

RegressionFile MakeRegressionFile(const GateOccasion& occasion, const Judgement& judgement) {
  RegressionFile file{occasion.name,
                      occasion.date,
                      occasion.commit,
                      occasion.cpu,
                      Headline(judgement),
                      static_cast<int>(judgement.Code()),
                      judgement.speed_not_judged,
                      {occasion.baseline.commit, occasion.baseline.date, occasion.baseline.cpu},
                      {},
                      judgement.failures,
                      {},
                      judgement.unknown,
                      judgement.unmeasured,
                      occasion.measured.runs};
  for (const auto& [run, changed] : judgement.changed_settings)
    file.changed_settings[run] = fmt::format("{}", fmt::join(changed, "; "));
  for (GatedRun& run : file.runs) run.settings.clear();
  for (const GateFinding& finding : judgement.findings) {
    file.findings.push_back({finding});
    if (finding.change != Change::kRegressed) file.findings.back().blame = {};
  }
  return file;
}

std::string ToJunit(const GateOccasion& occasion, const Judgement& judgement) {
  std::string cases;
  int failures = 0, errors = 0, count = 0;
  for (const GatedRun& run : occasion.measured.runs) {
    for (const NumberKind kind : {NumberKind::kAccuracy, NumberKind::kSpeed}) {
      if (kind == NumberKind::kSpeed && !judgement.speed_not_judged.empty()) {
        cases += JunitCase(run.name(), Name(kind), "skipped", judgement.speed_not_judged);
        ++count;
        continue;
      }
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
      "and more). {}\n\n",
      occasion.name, Headline(judgement), occasion.date, occasion.commit, occasion.cpu,
      occasion.baseline.commit, occasion.baseline.date, occasion.baseline.cpu,
      1e2 * occasion.tolerances.accuracy, 1e2 * occasion.tolerances.frame_time,
      1e2 * occasion.tolerances.step_time, 1e2 * occasion.tolerances.gated_step_share,
      SpeedText(occasion, judgement));
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
  text += SettingsList(judgement);
  return text + fmt::format("{} numbers are within tolerance.\n",
                            judgement.OfChange(Change::kWithin).size());
}

}  // namespace vitruvia
