#include "experiments/cli/regress_command.h"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <memory>
#include <set>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fmt/chrono.h>

#include "analysis/gate_reports.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/files.h"
#include "experiments/cli/regress_config.h"
#include "experiments/plan/experiment_config.h"
#include "experiments/studies/experiment_kinds.h"
#include "synth/bodies/body_source.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

struct RegressArguments {
  fs::path config, baseline, output, baseline_program;
  std::string only, reason;
  bool update = false, stored = false;
};

// Where the gate's files lie.
struct GatePlaces {
  fs::path baseline, output, shared, history;
};

GatePlaces PlacesOf(const RegressArguments& a) {
  const std::string name = ConfigName(a.config);
  GatePlaces places;
  places.baseline = a.baseline / (name + ".json");
  places.output = a.output.empty() ? fs::path("out") / name : a.output;
  places.shared = a.output.empty() ? fs::path("out") : a.output;
  places.history = places.output / "history.json";
  return places;
}

std::string NowUtc() {
  return fmt::format(
      "{:%Y-%m-%dT%H:%M:%SZ}",
      fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
}

void CheckArguments(const RegressArguments& a) {
  if (a.update && a.reason.empty())
    throw ConfigError("regress: --update needs --reason TEXT: why the baseline may change");
  if (a.update && !a.only.empty())
    throw ConfigError("regress: --update renews the whole baseline; --only cannot go with it");
  if (!a.update && !a.reason.empty())
    throw ConfigError("regress: --reason says why a baseline is renewed; expected --update too");
  if (!a.baseline_program.empty() && (a.update || a.stored)) {
    throw ConfigError(
        "regress: --baseline-program runs beside a new measurement; neither --update nor --stored "
        "can go with it");
  }
  if (!a.baseline_program.empty() && access(a.baseline_program.c_str(), X_OK) != 0) {
    const bool is_file = fs::is_regular_file(a.baseline_program);
    throw ConfigError(
        fmt::format("regress: --baseline-program {0}: {1}; {2}{0}", a.baseline_program.string(),
                    std::strerror(errno),
                    is_file ? "make it executable: chmod +x " : "expected a program, got "));
  }
}

// Everything that the experiments name is read and found.
std::vector<Experiment> Planned(const std::vector<GatedExperiment>& experiments,
                                const RegressArguments& a) {
  if (experiments.empty())
    throw ConfigError(fmt::format("regress: {}: no experiment whose name contains \"{}\"",
                                  a.config.string(), a.only));
  std::vector<Experiment> planned;
  for (const GatedExperiment& gated : experiments)
    planned.push_back(PlanAnyExperiment(gated.experiment, {"sequences", "learned"}));
  return planned;
}

// Checks that the bodies of all scenes can be generated, that is, that their data exist.
void CheckBodies(const std::vector<Experiment>& experiments) {
  std::set<std::string> checked;
  for (const Experiment& experiment : experiments) {
    for (const PlannedRun& run : experiment.runs) {
      if (!run.resolved.contains("scene") || !run.resolved.at("scene").contains("body")) continue;
      const Json& body = run.resolved.at("scene").at("body");
      if (!checked.insert(body.dump()).second) continue;
      MakeControlBody(ReadSettings<BodySettings>(body, ResolvedOrigin("scene.body")));
    }
  }
}

std::string NameInTheGate(const PlannedRun& planned) {
  GatedRun run;
  run.experiment = planned.experiment;
  run.variant = planned.variant;
  run.scene = planned.scene;
  run.method = planned.method;
  run.seed = planned.seed;
  return run.name();
}

// Runs of the baseline that would not be measured.
void CheckNames(const std::vector<Experiment>& experiments, const GateBaseline& baseline,
                const fs::path& file) {
  std::set<std::string> names;
  for (const Experiment& experiment : experiments) {
    for (const PlannedRun& run : experiment.runs) names.insert(NameInTheGate(run));
  }
  std::vector<std::string> missing;
  for (const GatedRun& run : baseline.runs) {
    if (!names.contains(run.name())) missing.push_back(run.name());
  }
  if (missing.empty()) return;
  throw Error(ExitCode::kNothingMeasured,
              fmt::format("{}: holds runs that the experiments do not have: {}; nothing was "
                          "measured. Mend the experiments, or renew the baseline: --update "
                          "--reason TEXT",
                          file.string(), fmt::join(missing, ", ")));
}

// Reports misspelt names and missing files before hours of measurement.
void CheckExperiments(const std::vector<GatedExperiment>& selected, const GateBaseline& baseline,
                      const GatePlaces& places, const RegressArguments& a) {
  const std::vector<Experiment> planned = Planned(selected, a);
  if (a.stored) return;
  CheckNames(planned, baseline, places.baseline);
  CheckBodies(planned);
}

MeasuredRuns Measured(const RegressArguments& a, const RegressSettings& settings,
                      const GatePlaces& places) {
  const std::vector<GatedExperiment> experiments = Selected(settings, a.only);
  if (!a.stored) MeasureRepeats(experiments, places.output, places.shared, a.baseline_program);
  return ReadRepeats(experiments, places.output);
}

void Renew(const RegressArguments& a, const GatePlaces& places, const MeasuredRuns& measured) {
  if (!measured.failures.empty()) {
    const auto& [run, reason] = *measured.failures.begin();
    throw RunError(fmt::format("{}: not renewed, since a run failed: {}: {}",
                               places.baseline.string(), run, reason));
  }
  if (measured.runs.empty()) {
    throw Error(ExitCode::kNothingMeasured,
                fmt::format("{}: not renewed: nothing measured", places.baseline.string()));
  }
  GateBaseline baseline;
  if (fs::exists(places.baseline)) baseline.renewals = ReadBaseline(places.baseline).renewals;
  baseline.date = NowUtc();
  baseline.commit = GetBuildInfo().commit;
  baseline.cpu = GetMachineInfo().cpu;
  baseline.renewals.push_back({baseline.date, baseline.commit, a.reason});
  baseline.runs = measured.runs;
  WriteBaseline(places.baseline, baseline);
  fmt::print("{}: renewed with {} runs\n", places.baseline.string(), baseline.runs.size());
}

// Only the selected experiments, so that the others do not count as missing.
GateBaseline SelectedBaseline(const GatePlaces& places, const std::string& only) {
  GateBaseline baseline = ReadBaseline(places.baseline);
  std::erase_if(baseline.runs, [&](const GatedRun& run) {
    return run.experiment.find(only) == std::string::npos;
  });
  return baseline;
}

void WriteOccasion(const GatePlaces& places, const GateOccasion& occasion,
                   const Judgement& judgement) {
  WriteStored(places.output / "regression.json", MakeRegressionFile(occasion, judgement), 2);
  WriteWholeFile(places.output / "regression.xml", ToJunit(occasion, judgement));
  const std::string text = ToMarkdown(occasion, judgement);
  WriteWholeFile(places.output / "regression.md", text);
  fmt::print("{}\nalso in {}/regression.{{md,json,xml}}\n", text, places.output.string());
}

void Regress(const RegressArguments& a) {
  CheckArguments(a);
  const auto settings = ReadSettingsFile<RegressSettings>(a.config);
  const GatePlaces places = PlacesOf(a);
  const std::string commit = GetBuildInfo().commit;
  const GateBaseline baseline = a.update ? GateBaseline() : SelectedBaseline(places, a.only);
  std::vector<HistoryEntry> history = ReadHistory(places.history);
  CheckExperiments(Selected(settings, a.only), baseline, places, a);
  MakeFolder(places.output);
  const MeasuredRuns measured = Measured(a, settings, places);
  if (a.update) return Renew(a, places, measured);

  const SpeedReference reference = ReadReference(Selected(settings, a.only), places.output);
  const Judgement judgement =
      Judge(baseline, measured, reference, settings.tolerances, history, commit);
  const GateOccasion occasion{settings.title,      NowUtc(), commit,   GetMachineInfo().cpu,
                              settings.tolerances, baseline, measured, reference};
  WriteOccasion(places, occasion, judgement);
  if (!a.stored) {
    history.push_back(
        {occasion.date, commit, occasion.cpu, static_cast<int>(judgement.Code()), measured.runs});
    WriteHistory(places.history, history);
  }
  if (judgement.Code() != ExitCode::kSuccess)
    throw Error(judgement.Code(), "regress: " + Headline(judgement));
}

}  // namespace

void AddRegressCommand(CLI::App& app) {
  const auto a = std::make_shared<RegressArguments>();
  CLI::App* regress =
      app.add_subcommand("regress", "Measure accuracy and speed and compare them with a baseline");
  regress->add_option("CONFIG", a->config, "what to measure: configs/nightly.json")->required();
  regress->add_option("--baseline", a->baseline, "folder of baselines")->required();
  regress->add_option("--baseline-program", a->baseline_program,
                      "program of the baseline's commit: it runs alternately with this one, and "
                      "speed is compared over the pairs; without it, only accuracy is compared");
  regress->add_option("-o,--output", a->output, "folder of the results; without it out/NAME");
  regress->add_option("--only", a->only, "only experiments whose name contains this text");
  regress->add_flag("--update", a->update, "replace the baseline by the measured numbers");
  regress->add_option("--reason", a->reason, "reason for replacing the baseline; stored in it");
  regress->add_flag("--stored", a->stored,
                    "compare the last measurement instead of measuring again");
  regress->footer(
      "Exit codes: 0 within tolerance, 4 a run failed, 5 accuracy regressed, 6 speed regressed, "
      "7 nothing measured or less than the baseline holds, 2 bad configuration, 3 damaged files.");
  regress->callback([a] { Regress(*a); });
}

}  // namespace vitruvia
