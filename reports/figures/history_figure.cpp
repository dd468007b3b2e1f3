#include "reports/figures/history_figure.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "analysis/printed_metric.h"
#include "reports/drawing/color_maps.h"

namespace vitruvia {
namespace {

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

std::optional<Metric> MainError(const GatedRun& run) {
  for (const Metric& metric : MetricsShownIn(Place::kHistoryPlot)) {
    if (run.accuracy.contains(metric.key)) return metric;
  }
  return std::nullopt;
}

std::optional<std::string> MainTime(const GatedRun& run) {
  for (const WholeTime& time : kWholeTimes) {
    if (run.speed.contains(time.name)) return time.name;
  }
  return std::nullopt;
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

using Numbers = std::map<std::string, double> GatedRun::*;

// A panel of one number of all runs, one line for each run.
Panel PanelOf(const std::vector<HistoryEntry>& history, const std::vector<GatedRun>& runs,
              const std::string& axis, Numbers numbers, const std::string& key, double scale) {
  Panel panel{"", OccasionAxis(history), axis, {}, {}, {}};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Color color = kRunColors[i % kRunColors.size()];
    panel.series.push_back(LineOf(history, runs[i], color, [&](const GatedRun& run) {
      const auto found = (run.*numbers).find(key);
      return found == (run.*numbers).end() ? NAN : scale * found->second;
    }));
  }
  return panel;
}

Figure ExperimentFigure(const std::vector<HistoryEntry>& history,
                        const std::vector<GatedRun>& runs) {
  Figure figure;
  figure.name = "history-" + runs.front().experiment;
  std::replace(figure.name.begin(), figure.name.end(), '/', '-');
  figure.title = runs.front().experiment;
  figure.caption = fmt::format(
      "Every measurement of the gate so far, from commit {} to {}; times are medians over the "
      "repeats.",
      history.front().commit, history.back().commit);
  figure.columns = 2;
  if (const auto error = MainError(runs.front())) {
    figure.panels.push_back(
        PanelOf(history, runs, Titled(*error), &GatedRun::accuracy, error->key, error->scale));
  }
  if (const auto time = MainTime(runs.front())) {
    figure.panels.push_back(
        PanelOf(history, runs, "median time / calibration kernel", &GatedRun::speed, *time, 1.0));
  }
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
