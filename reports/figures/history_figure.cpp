#include "reports/figures/history_figure.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "analysis/printed_metric.h"
#include "math/statistics.h"
#include "reports/drawing/color_maps.h"

namespace vitruvia {
namespace {

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
    if (run.times_ms.contains(time.name)) return time.name;
  }
  return std::nullopt;
}

std::string OccasionAxis(const std::vector<HistoryEntry>& history) {
  return fmt::format("measurement (number; 1: {}, {}: {})", history.front().date.substr(0, 10),
                     history.size(), history.back().date.substr(0, 10));
}

std::string LineName(const GatedRun& run) {
  return fmt::format("{}.{}.{}.s{}", run.variant, run.scene, run.method, run.seed);
}

// One number of a run over the occasions that `includes` chooses; `number` is NaN where the run has
// none.
template <class Includes, class Number>
Series LineOf(const std::vector<HistoryEntry>& history, const GatedRun& run, Color color,
              Includes includes, Number number) {
  Series line;
  line.name = LineName(run);
  line.color = color;
  for (std::size_t i = 0; i < history.size(); ++i) {
    const GatedRun* then = includes(history[i]) ? FindRun(history[i].runs, run.name()) : nullptr;
    line.x.push_back(static_cast<double>(i + 1));
    line.y.push_back(then == nullptr ? NAN : number(*then));
  }
  return line;
}

Panel ErrorPanel(const std::vector<HistoryEntry>& history, const std::vector<GatedRun>& runs,
                 const Metric& error) {
  Panel panel{"", OccasionAxis(history), Titled(error), {}, {}, {}};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Color color = kRunColors[i % kRunColors.size()];
    const auto everywhere = [](const HistoryEntry&) { return true; };
    panel.series.push_back(LineOf(history, runs[i], color, everywhere, [&](const GatedRun& run) {
      const auto found = run.accuracy.find(error.key);
      return found == run.accuracy.end() ? NAN : error.scale * found->second;
    }));
  }
  return panel;
}

std::set<std::string> MachinesOf(const std::vector<HistoryEntry>& history) {
  std::set<std::string> cpus;
  for (const HistoryEntry& entry : history) cpus.insert(entry.cpu);
  return cpus;
}

// A line for each run on each machine: times of different machines do not compare.
Panel TimePanel(const std::vector<HistoryEntry>& history, const std::vector<GatedRun>& runs,
                const std::string& timed) {
  Panel panel{"", OccasionAxis(history), "median time (ms)", {}, {}, {}};
  const std::set<std::string> cpus = MachinesOf(history);
  for (const GatedRun& run : runs) {
    for (const std::string& cpu : cpus) {
      const Color color = kRunColors[panel.series.size() % kRunColors.size()];
      const auto on_this = [&](const HistoryEntry& entry) { return entry.cpu == cpu; };
      Series line = LineOf(history, run, color, on_this, [&](const GatedRun& then) {
        const auto found = then.times_ms.find(timed);
        return found == then.times_ms.end() ? NAN : Quantile(found->second, 0.5);
      });
      if (cpus.size() > 1) line.name += " on " + cpu;
      panel.series.push_back(std::move(line));
    }
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
      "repeats, and compare on one machine only.",
      history.front().commit, history.back().commit);
  figure.columns = 2;
  if (const auto error = MainError(runs.front())) {
    figure.panels.push_back(ErrorPanel(history, runs, *error));
  }
  if (const auto time = MainTime(runs.front())) {
    figure.panels.push_back(TimePanel(history, runs, *time));
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
