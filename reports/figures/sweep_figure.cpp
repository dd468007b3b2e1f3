#include "reports/figures/sweep_figure.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "analysis/paired_comparison.h"
#include "analysis/printed_metric.h"
#include "analysis/swept_settings.h"
#include "math/statistics.h"
#include "records/metric_value.h"
#include "reports/drawing/color_maps.h"
#include "reports/figures/figure_parts.h"
#include "reports/figures/speed_figure.h"

namespace vitruvia {
namespace {

using Runs = std::vector<const RunRecord*>;
using Json = nlohmann::json;

constexpr double kSceneWidth = 0.9, kMeanWidth = 2.4;

// The runs of one value of a setting.
struct SweptValue {
  Json value;
  Runs runs;
};

// Runs of one variant and method, without what the sweep added to its name.
struct SweptVariant {
  std::string name;
  std::vector<SweptValue> values;  // in order of size, or of the grid
};

bool IsNumber(const Json& value) { return value.is_number(); }

bool AreNumbers(const std::vector<SweptVariant>& variants) {
  return std::all_of(variants.begin(), variants.end(), [](const SweptVariant& variant) {
    return std::all_of(variant.values.begin(), variant.values.end(),
                       [](const SweptValue& v) { return IsNumber(v.value); });
  });
}

void AddRun(SweptVariant& variant, const Json& value, const RunRecord* run) {
  const auto found = std::find_if(variant.values.begin(), variant.values.end(),
                                  [&](const SweptValue& v) { return v.value == value; });
  if (found == variant.values.end()) {
    variant.values.push_back({value, {run}});
  } else {
    found->runs.push_back(run);
  }
}

// "method/variant" without what the sweep added; the method alone where all variants are one.
std::string NameOf(const RunRecord& run, const ReportedExperiment& experiment) {
  const std::vector<const RunRecord*> runs = experiment.finished();
  const std::string unswept = UnsweptName(run.variant);
  const bool is_only_one = std::all_of(
      runs.begin(), runs.end(),
      [&unswept](const RunRecord* other) { return UnsweptName(other->variant) == unswept; });
  return is_only_one ? run.method : fmt::format("{}/{}", run.method, unswept);
}

SweptVariant& VariantOf(const std::string& name, std::vector<SweptVariant>& variants) {
  for (SweptVariant& variant : variants) {
    if (variant.name == name) return variant;
  }
  return variants.emplace_back(SweptVariant{name, {}});
}

// The runs in which only this setting differs from its default.
std::vector<SweptVariant> VariantsOver(const SweptSetting& setting,
                                       const ReportedExperiment& experiment) {
  std::vector<SweptVariant> variants;
  for (const RunRecord* run : experiment.finished()) {
    if (!AreOthersAtDefault(*run, experiment.record.sweep, &setting)) continue;
    AddRun(VariantOf(NameOf(*run, experiment), variants), ValueAt(run->config, setting.path), run);
  }
  if (AreNumbers(variants)) {
    for (SweptVariant& variant : variants)
      std::sort(variant.values.begin(), variant.values.end(), [](const auto& a, const auto& b) {
        return a.value.template get<double>() < b.value.template get<double>();
      });
  }
  std::erase_if(variants, [](const SweptVariant& variant) { return variant.values.size() < 2; });
  if (variants.size() == 1) variants.front().name = "mean";
  return variants;
}

std::vector<Metric> MetricsOf(const ReportedExperiment& experiment) {
  std::vector<Metric> metrics;
  for (const std::string& key : experiment.record.table_columns) metrics.push_back(FindMetric(key));
  if (metrics.empty()) metrics = {ErrorMetricOf(experiment), FindMetric("frame_ms_median")};
  return metrics;
}

// The metric of the runs by scene, scaled to its unit; scenes without a value are left out.
std::map<std::string, std::vector<double>> ByScene(const Runs& runs, const Metric& metric) {
  std::map<std::string, std::vector<double>> scenes;
  for (const RunRecord* run : runs) {
    const double value = MetricValue(*run, metric);
    if (!std::isnan(value)) scenes[run->scene].push_back(metric.scale * value);
  }
  return scenes;
}

// Positions of values on the axis: numbers at their value, texts at 0, 1, 2 ….
class ValueAxis {
 public:
  ValueAxis(const std::vector<SweptVariant>& variants, SweepScale scale)
      : numbers_(AreNumbers(variants)) {
    for (const SweptVariant& variant : variants) {
      for (const SweptValue& v : variant.values) {
        if (std::find(values_.begin(), values_.end(), v.value) == values_.end())
          values_.push_back(v.value);
      }
    }
    const bool positive = std::all_of(values_.begin(), values_.end(), [](const Json& value) {
      return IsNumber(value) && value.get<double>() > 0.0;
    });
    if (scale == SweepScale::kLogarithmic && positive) scale_ = Scale::kLogarithmic;
  }

  std::optional<double> Position(const Json& value) const {
    if (numbers_) return IsNumber(value) ? std::optional(value.get<double>()) : std::nullopt;
    const auto found = std::find(values_.begin(), values_.end(), value);
    if (found == values_.end()) return std::nullopt;
    return static_cast<double>(found - values_.begin());
  }
  std::vector<Tick> Names() const {
    std::vector<Tick> ticks;
    for (std::size_t i = 0; !numbers_ && i < values_.size(); ++i)
      ticks.push_back({static_cast<double>(i), PrintedValue(values_[i])});
    return ticks;
  }
  Scale scale() const { return scale_; }

 private:
  bool numbers_;
  std::vector<Json> values_;
  Scale scale_ = Scale::kLinear;
};

Series MeanLine(const SweptVariant& variant, Color color, const Metric& metric,
                const ValueAxis& axis) {
  Series line;
  line.name = variant.name;
  line.color = color;
  line.width = kMeanWidth;
  line.mark = Mark::kLineWithPoints;
  for (const SweptValue& v : variant.values) {
    Groups groups;
    std::vector<double> all;
    for (const auto& [scene, values] : ByScene(v.runs, metric)) {
      groups.push_back(values);
      all.insert(all.end(), values.begin(), values.end());
    }
    if (all.empty()) continue;
    const double mean = Mean(all);
    Interval interval = GroupedMeanInterval(groups, {});
    if (std::isinf(interval.low)) interval = {mean, mean};
    line.x.push_back(*axis.Position(v.value));
    line.y.push_back(mean);
    line.y_low.push_back(interval.low);
    line.y_high.push_back(interval.high);
  }
  return line;
}

std::vector<Series> SceneLines(const SweptVariant& variant, const Metric& metric,
                               const ValueAxis& axis) {
  std::map<std::string, Series> lines;
  for (const SweptValue& v : variant.values) {
    for (const auto& [scene, values] : ByScene(v.runs, metric)) {
      lines[scene].x.push_back(*axis.Position(v.value));
      lines[scene].y.push_back(Mean(values));
    }
  }
  std::vector<Series> all;
  if (lines.size() < 2) return all;
  for (auto& [scene, line] : lines) {
    line.name = scene;
    line.color = VariantColor(1 + all.size());
    line.width = kSceneWidth;
    all.push_back(std::move(line));
  }
  return all;
}

std::vector<double> ValuesIn(const Panel& panel) {
  std::vector<double> values;
  for (const Series& series : panel.series)
    values.insert(values.end(), series.y.begin(), series.y.end());
  return values;
}

Panel SweepPanel(const SweptSetting& setting, const std::vector<SweptVariant>& variants,
                 const Metric& metric) {
  const ValueAxis axis(variants, setting.scale);
  Panel panel{"", ShortName(setting), Titled(metric), {}, {}, {}};
  panel.x_scale = axis.scale();
  panel.x_ticks = axis.Names();
  if (variants.size() == 1) panel.series = SceneLines(variants.front(), metric, axis);
  for (std::size_t i = 0; i < variants.size(); ++i) {
    panel.series.push_back(MeanLine(variants[i], VariantColor(i), metric, axis));
    if (i >= kRunColors.size()) panel.series.back().dash = kSecondRoundDash;
  }
  panel.y_scale = ScaleFor(ValuesIn(panel));
  if (const std::optional<double> at = axis.Position(setting.default_value))
    panel.x_references = {{"default: " + PrintedValue(setting.default_value), *at}};
  return panel;
}

bool HasValues(const Panel& panel) {
  return std::any_of(panel.series.begin(), panel.series.end(),
                     [](const Series& series) { return !series.y.empty(); });
}

std::optional<Figure> CurveFigure(const SweptSetting& setting,
                                  const ReportedExperiment& experiment) {
  const std::vector<SweptVariant> variants = VariantsOver(setting, experiment);
  if (variants.empty()) return std::nullopt;
  Figure figure;
  figure.name = "sweep-" + FileSafe(ShortName(setting));
  figure.title = "Swept: " + ShortName(setting);
  figure.caption = fmt::format(
      "The other settings are at their defaults. Thick: the mean over all scenes and seeds, with "
      "its {:.0f} % bootstrap interval, which draws scenes, then seeds; thin: single scenes.",
      1e2 * BootstrapSettings{}.confidence);
  figure.columns = 2;
  for (const Metric& metric : MetricsOf(experiment)) {
    Panel panel = SweepPanel(setting, variants, metric);
    if (HasValues(panel)) figure.panels.push_back(std::move(panel));
  }
  for (const SweptVariant& variant : variants) {
    for (const SweptValue& v : variant.values)
      AddRuns(fmt::format("{} at {}", variant.name, PrintedValue(v.value)), v.runs, figure);
  }
  if (figure.panels.empty()) return std::nullopt;
  return figure;
}

std::vector<Json> ValuesOf(const SweptSetting& setting, const Runs& runs) {
  std::vector<Json> values;
  for (const RunRecord* run : runs) {
    const Json value = ValueAt(run->config, setting.path);
    if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
  }
  if (std::all_of(values.begin(), values.end(), IsNumber))
    std::sort(values.begin(), values.end(),
              [](const Json& a, const Json& b) { return a.get<double>() < b.get<double>(); });
  return values;
}

std::vector<Tick> TicksOf(const std::vector<Json>& values) {
  std::vector<Tick> ticks;
  for (std::size_t i = 0; i < values.size(); ++i)
    ticks.push_back({static_cast<double>(i), PrintedValue(values[i])});
  return ticks;
}

std::optional<int> IndexOf(const Json& value, const std::vector<Json>& values) {
  const auto found = std::find(values.begin(), values.end(), value);
  if (found == values.end()) return std::nullopt;
  return static_cast<int>(found - values.begin());
}

Panel MapPanel(const SweptSetting& x, const SweptSetting& y, const Runs& runs,
               const Metric& metric) {
  const std::vector<Json> xs = ValuesOf(x, runs), ys = ValuesOf(y, runs);
  Panel panel{Titled(metric), ShortName(x), ShortName(y), {}, {}, {}};
  panel.x_ticks = TicksOf(xs);
  panel.y_ticks = TicksOf(ys);
  CellMap cells;
  for (const Json& y_value : ys) {
    std::vector<double>& row = cells.values.emplace_back();
    std::vector<std::string>& texts = cells.texts.emplace_back();
    for (const Json& x_value : xs) {
      std::vector<double> values;
      for (const RunRecord* run : runs) {
        if (ValueAt(run->config, x.path) != x_value || ValueAt(run->config, y.path) != y_value)
          continue;
        if (!std::isnan(MetricValue(*run, metric))) values.push_back(MetricValue(*run, metric));
      }
      row.push_back(MeanOrAbsent(values));
      texts.push_back(values.empty() ? "" : Printed(row.back(), metric));
    }
  }
  const auto x_default = IndexOf(x.default_value, xs), y_default = IndexOf(y.default_value, ys);
  if (x_default && y_default) cells.framed = std::pair(*x_default, *y_default);
  panel.cells = cells;
  return panel;
}

// Of a grid: whether some run has both settings away from their defaults.
bool IsGrid(const SweptSetting& x, const SweptSetting& y, const Runs& runs) {
  return std::any_of(runs.begin(), runs.end(), [&](const RunRecord* run) {
    return !IsAtDefault(*run, x) && !IsAtDefault(*run, y);
  });
}

std::optional<Figure> MapFigure(const SweptSetting& x, const SweptSetting& y,
                                const ReportedExperiment& experiment) {
  const Runs runs = experiment.finished();
  if (!IsGrid(x, y, runs)) return std::nullopt;
  Figure figure;
  figure.name = FileSafe(fmt::format("map-{}-{}", ShortName(x), ShortName(y)));
  figure.title = fmt::format("Swept: {} and {}", ShortName(x), ShortName(y));
  figure.caption =
      "Means over all scenes and seeds. Dark is a large value; the frame is round the defaults, "
      "where the grid holds them.";
  figure.columns = 2;
  for (const Metric& metric : MetricsOf(experiment))
    figure.panels.push_back(MapPanel(x, y, runs, metric));
  return figure;
}

}  // namespace

std::vector<Figure> MakeSweepFigures(const ReportedExperiment& experiment) {
  std::vector<Figure> figures;
  const std::vector<SweptSetting>& sweep = experiment.record.sweep;
  for (const SweptSetting& setting : sweep) {
    if (auto figure = CurveFigure(setting, experiment)) figures.push_back(std::move(*figure));
  }
  if (sweep.size() == 2) {
    if (auto figure = MapFigure(sweep[0], sweep[1], experiment)) figures.push_back(*figure);
  }
  return figures;
}

}  // namespace vitruvia
