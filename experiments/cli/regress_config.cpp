#include "experiments/cli/regress_config.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "analysis/experiment_runs.h"
#include "core/error.h"
#include "core/files.h"
#include "core/progress.h"
#include "experiments/plan/experiment_config.h"
#include "experiments/run/child_process.h"
#include "experiments/run/experiment_files.h"
#include "experiments/run/runner.h"
#include "experiments/studies/experiment_kinds.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr int kJobs = 1;  // speed is measured
constexpr const char* kReferenceFolder = "baseline";

fs::path RepeatFolder(const fs::path& folder, const fs::path& experiment, int repeat) {
  return folder / fmt::format("repeat-{}", repeat) / ConfigName(experiment);
}

// Removes only a folder that an experiment has written.
void RemoveMeasured(const fs::path& folder) {
  if (!fs::exists(folder)) return;
  if (!fs::is_regular_file(folder / "experiment.json")) {
    throw RunError(fmt::format("{}: holds no experiment, so it is not removed", folder.string()));
  }
  fs::remove_all(folder);
}

void Measure(const GatedExperiment& gated, int repeat, const fs::path& folder,
             const fs::path& shared) {
  const fs::path repeat_folder = RepeatFolder(folder, gated.experiment, repeat);
  const Experiment planned =
      PlanAnyExperiment(gated.experiment, {shared / "sequences", shared / "learned"});
  RemoveMeasured(repeat_folder);
  WritePlan(planned, gated.experiment, repeat_folder);
  CarryOutRuns(planned.runs, kJobs, repeat_folder);
  WriteSummary(repeat_folder);
}

// Removes only what an earlier measurement has left.
void RemoveReference(const fs::path& folder) {
  if (!fs::exists(folder / kReferenceFolder)) return;
  for (const auto& repeat : fs::directory_iterator(folder / kReferenceFolder)) {
    if (!repeat.path().filename().string().starts_with("repeat-")) {
      throw RunError(fmt::format("{}: was not written by regress, so {} is not removed",
                                 repeat.path().string(), (folder / kReferenceFolder).string()));
    }
  }
  fs::remove_all(folder / kReferenceFolder);
}

// What goes wrong in it shows when the runs are read.
void MeasureReference(const GatedExperiment& gated, int repeat, const fs::path& folder,
                      const fs::path& program) {
  if (program.empty()) return;
  const fs::path output = RepeatFolder(folder / kReferenceFolder, gated.experiment, repeat);
  MakeFolder(output.parent_path());
  fs::path messages = output;
  messages += ".messages.txt";
  ChildProcesses children;
  children.Start(0, {fs::absolute(program),
                     {"run", fs::absolute(gated.experiment).string(), "-o", output.string()},
                     messages,
                     {}});
  while (children.running() > 0) {
    children.TakeEnded();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ThrowIfInterrupted();
  }
}

std::string CommitOf(const ReportedExperiment& experiment) {
  const std::vector<const RunRecord*> finished = experiment.finished();
  return finished.empty() ? "unknown" : finished.front()->provenance.value("commit", "unknown");
}

int MostRepeats(const std::vector<GatedExperiment>& experiments) {
  int most = 0;
  for (const GatedExperiment& gated : experiments) most = std::max(most, gated.repeats);
  return most;
}

void ReadExperimentRepeats(const GatedExperiment& gated, const fs::path& folder,
                           MeasuredRuns& measured) {
  const std::string name = ConfigName(gated.experiment);
  std::vector<std::string> order;
  std::map<std::string, std::vector<RunRecord>> repeats;
  for (int repeat = 1; repeat <= gated.repeats; ++repeat) {
    for (const ReportedRun& run :
         ReadExperiment(RepeatFolder(folder, gated.experiment, repeat)).runs) {
      if (run.record) {
        if (repeats[run.run_id].empty()) order.push_back(run.run_id);
        repeats[run.run_id].push_back(*run.record);
      } else {
        measured.failures[fmt::format("{}: {}", name, run.run_id)] =
            fmt::format("repeat {}: {}", repeat, run.problem);
      }
    }
  }
  for (const std::string& run_id : order)
    measured.runs.push_back(MakeGatedRun(name, repeats.at(run_id)));
}

}  // namespace

void GatedExperiment::Describe(Fields& f) {
  f.File("experiment", experiment, {.meaning = "experiment file", .required = true});
  f.Integer("repeats", repeats,
            {.meaning = "number of repeats of the experiment; speed is the median over the repeats",
             .min = 1,
             .max = 100});
}

void RegressSettings::Describe(Fields& f) {
  f.Text("title", title, {.meaning = "title of the gate's reports", .required = true});
  f.Text("description", description,
         {.meaning = "what the gate protects, for readers of the config"});
  f.List("experiments", experiments,
         {.meaning = "experiments that are measured", .required = true});
  f.Section("tolerances", tolerances, {.meaning = "changes that do not count as a regression"});
}

std::vector<GatedExperiment> Selected(const RegressSettings& settings, const std::string& only) {
  std::vector<GatedExperiment> selected = settings.experiments;
  std::erase_if(selected, [&](const GatedExperiment& gated) {
    return ConfigName(gated.experiment).find(only) == std::string::npos;
  });
  return selected;
}

void MeasureRepeats(const std::vector<GatedExperiment>& experiments, const fs::path& folder,
                    const fs::path& shared, const fs::path& baseline_program) {
  RemoveReference(folder);
  for (int repeat = 1; repeat <= MostRepeats(experiments); ++repeat) {
    for (const GatedExperiment& gated : experiments) {
      if (repeat > gated.repeats) continue;
      const bool baseline_first = repeat % 2 == 0;
      if (baseline_first) MeasureReference(gated, repeat, folder, baseline_program);
      Measure(gated, repeat, folder, shared);
      if (!baseline_first) MeasureReference(gated, repeat, folder, baseline_program);
    }
  }
}

SpeedReference ReadReference(const std::vector<GatedExperiment>& experiments,
                             const fs::path& folder) {
  SpeedReference reference;
  const fs::path of_baseline = folder / kReferenceFolder;
  if (!fs::exists(of_baseline)) {
    reference.problem = "no program of the baseline on this machine (--baseline-program)";
    return reference;
  }
  try {
    MeasuredRuns measured = ReadRepeats(experiments, of_baseline);
    if (!measured.failures.empty()) {
      const auto& [run, reason] = *measured.failures.begin();
      reference.problem = fmt::format("the baseline's program: {}: {}", run, reason);
      return reference;
    }
    reference.runs = std::move(measured.runs);
    reference.commit =
        CommitOf(ReadExperiment(RepeatFolder(of_baseline, experiments.front().experiment, 1)));
  } catch (const Error& error) {
    reference.problem =
        std::string("the baseline's program left nothing readable: ") + error.what();
  }
  return reference;
}

MeasuredRuns ReadRepeats(const std::vector<GatedExperiment>& experiments, const fs::path& folder) {
  MeasuredRuns measured;
  for (const GatedExperiment& gated : experiments) ReadExperimentRepeats(gated, folder, measured);
  return measured;
}

}  // namespace vitruvia
