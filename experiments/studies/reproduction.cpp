#include "experiments/studies/reproduction.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>

#include "core/error.h"
#include "core/message.h"
#include "core/timer.h"
#include "experiments/plan/experiment_config.h"
#include "experiments/plan/run_plan.h"
#include "experiments/plan/run_selection.h"
#include "experiments/run/experiment_files.h"
#include "experiments/run/machine_lock.h"
#include "experiments/run/runner.h"
#include "experiments/studies/experiment_kinds.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr double kMsPerSecond = 1000.0;

bool ChangesSettings(const ExperimentReduction* reduction) {
  return reduction != nullptr && (reduction->most_frames > 0 || !reduction->seeds.empty());
}

// Frames and seeds are settings of tracking experiments only; the file of another kind has keys
// that these have not, and is refused.
Experiment PlanReduced(const fs::path& file, const ExperimentReduction& reduction,
                       const WorkFolders& work) {
  auto settings = ReadSettingsFile<ExperimentSettings>(file);
  if (reduction.most_frames > 0) {
    settings.most_frames = reduction.most_frames;
    std::erase_if(settings.picture_frames,
                  [&](int frame) { return frame >= reduction.most_frames; });
  }
  if (!reduction.seeds.empty()) settings.seeds = reduction.seeds;
  const ExperimentPlan plan = PlanExperiment(settings, file);
  return {plan.record, plan.failed_frames_limit, PlannedRuns(plan, work)};
}

struct MadeExperiment {
  ReportedExperiment records;
  std::string problem;  // why it could not be planned
  double seconds = 0.0;
  int done = 0;
};

ReportedExperiment Chosen(ReportedExperiment experiment, const std::vector<PlannedRun>& runs) {
  std::erase_if(experiment.runs, [&runs](const ReportedRun& reported) {
    return std::none_of(runs.begin(), runs.end(), [&reported](const PlannedRun& run) {
      return run.run_id == reported.run_id;
    });
  });
  return experiment;
}

Experiment Plan(const fs::path& file, const ExperimentReduction* reduction,
                const WorkFolders& work) {
  return ChangesSettings(reduction) ? PlanReduced(file, *reduction, work)
                                    : PlanAnyExperiment(file, work);
}

void CarryOut(const Experiment& experiment, const ExperimentReduction* reduction,
              const fs::path& file, const fs::path& folder, int jobs, MadeExperiment& made) {
  RequireOwnFolder(folder, file);
  const RunSelection selection{reduction == nullptr ? "" : reduction->only, ""};
  const std::vector<PlannedRun> runs = SelectedRuns(experiment.runs, selection);
  WritePlan(experiment, file, folder);
  made.done = CarryOutRuns(runs, jobs, folder).done;
  WriteSummary(folder);
  made.records = Chosen(ReadExperiment(folder), runs);
}

MadeExperiment Make(const fs::path& file, const ExperimentReduction* reduction,
                    const fs::path& root, int jobs) {
  const Stopwatch watch;
  MadeExperiment made;
  std::optional<Experiment> experiment;
  try {
    experiment = Plan(file, reduction, {root / "sequences", root / "learned"});
  } catch (const Error& error) {
    made.problem = error.what();
    PrintMessage("{}\n", error.what());
  }
  if (experiment) CarryOut(*experiment, reduction, file, root / ConfigName(file), jobs, made);
  made.seconds = watch.ElapsedMs() / kMsPerSecond;
  return made;
}

}  // namespace

std::vector<ReproducedFigure> WithOwnEval(std::vector<ReproducedFigure> figures) {
  const char* folder = std::getenv(kEvalVariable);
  if (folder == nullptr || *folder == '\0') return figures;
  for (ReproducedFigure& figure : figures) {
    if (!figure.eval_experiments.empty()) figure.experiments = figure.eval_experiments;
  }
  return figures;
}

CarriedOutFigures CarryOutFigures(const ReproductionList& list,
                                  const std::vector<ReproducedFigure>& figures,
                                  const fs::path& root, int jobs) {
  MachineLockFile();  // reports its errors before anything is written
  std::vector<fs::path> files;
  for (const ReproducedFigure& figure : figures) {
    for (const fs::path& file : figure.experiments) {
      if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
    }
  }
  CarriedOutFigures result;
  std::map<fs::path, MadeExperiment> made;
  for (std::size_t i = 0; i < files.size(); ++i) {
    PrintMessage("experiment {}/{}: {}\n", i + 1, files.size(), ConfigName(files[i]));
    const MadeExperiment& experiment = made[files[i]] =
        Make(files[i], list.ReductionOf(files[i]), root, jobs);
    if (experiment.done > 0) result.times.push_back({files[i], experiment.seconds});
  }
  for (const ReproducedFigure& figure : figures) {
    FigureRecords& records = result.figures.emplace_back();
    records.figure = figure;
    for (const fs::path& file : figure.experiments) {
      const MadeExperiment& experiment = made.at(file);
      if (!experiment.problem.empty()) {
        records.problems.push_back(
            fmt::format("without {}: {}", ConfigName(file), experiment.problem));
      } else {
        records.experiments.push_back(experiment.records);
      }
    }
  }
  return result;
}

}  // namespace vitruvia
