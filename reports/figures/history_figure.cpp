#include "reports/figures/history_figure.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "analysis/metric_names.h"
#include "reports/drawing/color_maps.h"

namespace vitruvia {
namespace {

// The first of these that an experiment has is its main error.
constexpr std::array kMainErrors = {"l2_mean_m", "surface_mean_m", "joint_error_mean_m"};
constexpr std::array kMainTimes = {kWholeFrame, "fit"};

double NumberOr(const std::map<std::string, double>& numbers, const std::string& key,
                double otherwise) {
  const auto found = numbers.find(key);
  return found == numbers.end() ? otherwise : found->second;
}

const GatedRun* RunOf(const HistoryEntry& entry, const std::string& name) {
  for (const GatedRun& run : entry.runs) {
    if (run.name() == name) return &run;
  }
  return nullptr;
}

// The runs that were ever measured, in the order in which they came.
std::vector<GatedRun> RunsOf(const std::vector<HistoryEntry>& history) {
  std::vector<GatedRun> runs;
  for (const HistoryEntry& entry : history) {
    for (const GatedRun& run : entry.runs) {
      const bool known = std::any_of(runs.begin(), runs.end(), [&](const GatedRun& other) {
        return other.name() == run.name();
      });
      if (!known) runs.push_back(run);
    }
  }
  return runs;
}

template <class Keys>
std::string FirstOf(const Keys& keys, const std::map<std::string, double>& numbers) {
  for (const char* key : keys) {
    if (numbers.contains(key)) return key;
  }
  return "";
}

template <class Number>
Series LineOf(const std::vector<HistoryEntry>& history, const GatedRun& run, Color color,
              Number number) {
  Series line;
  line.name = fmt::format("{}.{}.{}.s{}", run.variant, run.scene, run.method, run.seed);
  line.color = color;
  for (std::size_t i = 0; i < history.size(); ++i) {
    const GatedRun* then = RunOf(history[i], run.name());
    line.x.push_back(static_cast<double>(i + 1));
    line.y.push_back(then == nullptr ? NAN : number(*then));
  }
  return line;
}

std::string OccasionAxis(const std::vector<HistoryEntry>& history) {
  return fmt::format("measurement (number; 1: {}, {}: {})", history.front().date.substr(0, 10),
                     history.size(), history.back().date.substr(0, 10));
}

Figure ExperimentFigure(const std::vector<HistoryEntry>& history,
                        const std::vector<GatedRun>& runs) {
  const std::string error = FirstOf(kMainErrors, runs.front().accuracy);
  const std::string time = FirstOf(kMainTimes, runs.front().speed);
  const MetricName metric = NameOfMetric(error);
  Panel errors{"", OccasionAxis(history), Titled(metric), {}, {}, {}};
  Panel times{"", OccasionAxis(history), "median time / calibration kernel", {}, {}, {}};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Color color = kRunColors[i % kRunColors.size()];
    errors.series.push_back(LineOf(history, runs[i], color, [&](const GatedRun& run) {
      return NumberOr(run.accuracy, error, NAN) * metric.scale;
    }));
    times.series.push_back(LineOf(history, runs[i], color, [&](const GatedRun& run) {
      return NumberOr(run.speed, time, NAN);
    }));
  }
  Figure figure;
  figure.name = "history-" + runs.front().experiment;
  std::replace(figure.name.begin(), figure.name.end(), '/', '-');
  figure.title = runs.front().experiment;
  figure.caption = fmt::format(
      "Every measurement of the gate so far, from commit {} to {}; times are medians over the "
      "repeats.",
      history.front().commit, history.back().commit);
  figure.columns = 2;
  if (!error.empty()) figure.panels.push_back(std::move(errors));
  if (!time.empty()) figure.panels.push_back(std::move(times));
  return figure;
}

}  // namespace

std::vector<Figure> MakeHistoryFigures(const std::vector<HistoryEntry>& history) {
  std::vector<std::vector<GatedRun>> by_experiment;
  for (const GatedRun& run : RunsOf(history)) {
    const auto found =
        std::find_if(by_experiment.begin(), by_experiment.end(),
                     [&](const auto& runs) { return runs.front().experiment == run.experiment; });
    if (found == by_experiment.end()) {
      by_experiment.push_back({run});
    } else {
      found->push_back(run);
    }
  }
  std::vector<Figure> figures;
  for (const std::vector<GatedRun>& runs : by_experiment)
    figures.push_back(ExperimentFigure(history, runs));
  std::erase_if(figures, [](const Figure& figure) { return figure.panels.empty(); });
  return figures;
}

}  // namespace vitruvia
