#include "reports/figures/step_figure.h"

#include <algorithm>
#include <cmath>

#include "analysis/variant_comparison.h"
#include "math/statistics.h"
#include "reports/drawing/color_maps.h"
#include "reports/figures/figure_parts.h"

namespace vitruvia {
namespace {

// Steps in the order of the methods; a step that only one method has follows its predecessors in
// that method.
std::vector<std::string> StepNames(const std::vector<Contender>& contenders) {
  std::vector<std::string> names;
  for (const Contender& contender : contenders) {
    for (const RunRecord::Step& step : contender.runs.front()->steps) {
      if (std::find(names.begin(), names.end(), step.name) == names.end())
        names.push_back(step.name);
    }
  }
  return names;
}

double MeanOfMedians(const Contender& contender, const std::string& name) {
  std::vector<double> medians;
  for (const RunRecord* run : contender.runs) {
    for (const RunRecord::Step& step : run->steps) {
      if (step.name == name) medians.push_back(step.median_ms);
    }
  }
  return MeanOrAbsent(medians);
}

// Steps beyond the palette take its colours again, paler.
Color StepColor(std::size_t index) {
  Color color = VariantColor(index);
  if (index < kRunColors.size()) return color;
  for (std::uint8_t& channel : color) channel = static_cast<std::uint8_t>(128 + channel / 2);
  return color;
}

}  // namespace

std::optional<Figure> MakeStepFigure(const ReportedExperiment& experiment) {
  std::vector<Contender> contenders = ContendersOf(experiment);
  std::erase_if(contenders, [](const Contender& c) { return c.runs.front()->steps.empty(); });
  if (contenders.empty()) return std::nullopt;
  Figure figure;
  figure.name = "time-per-step";
  figure.title = "Time per step";
  figure.caption =
      "Median time of each step of a frame, summed over the frame's iterations; the mean over a "
      "variant's runs. Medians need not add up to the median of the whole frame.";
  Panel panel{"", "time (ms)" + ThreadsText(experiment.finished()), "", {}, {}, {}};
  for (std::size_t c = 0; c < contenders.size(); ++c)
    panel.y_ticks.push_back({static_cast<double>(c), contenders[contenders.size() - 1 - c].name});
  const std::vector<std::string> names = StepNames(contenders);
  for (std::size_t s = 0; s < names.size(); ++s) {
    Series bars;
    bars.name = names[s];
    bars.color = StepColor(s);
    bars.mark = Mark::kStackedBars;
    for (std::size_t c = 0; c < contenders.size(); ++c) {
      bars.x.push_back(MeanOfMedians(contenders[contenders.size() - 1 - c], names[s]));
      bars.y.push_back(static_cast<double>(c));
    }
    panel.series.push_back(std::move(bars));
  }
  for (const Contender& contender : contenders) AddRuns(contender.name, contender.runs, figure);
  figure.panels = {std::move(panel)};
  return figure;
}

}  // namespace vitruvia
