#include "reports/figures/figure_parts.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "reports/drawing/color_maps.h"

namespace vitruvia {

Series MeanCurve(const std::string& name, Color color, const std::vector<double>& x,
                 const std::vector<std::vector<double>>& curves) {
  Series series;
  series.name = name;
  series.color = color;
  series.x = x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    double sum = 0.0, low = NAN, high = NAN;
    int count = 0;
    for (const std::vector<double>& curve : curves) {
      if (i >= curve.size() || std::isnan(curve[i])) continue;
      sum += curve[i];
      low = std::fmin(low, curve[i]);
      high = std::fmax(high, curve[i]);
      ++count;
    }
    series.y.push_back(count == 0 ? NAN : sum / count);
    if (curves.size() < 2) continue;
    series.y_low.push_back(low);
    series.y_high.push_back(high);
  }
  return series;
}

void AddRuns(const std::string& name, const std::vector<const RunRecord*>& runs, Figure& figure) {
  std::vector<std::string>& ids = figure.runs.emplace_back(name, std::vector<std::string>{}).second;
  for (const RunRecord* run : runs) ids.push_back(run->run_id);
}

std::string FileSafe(std::string text) {
  for (char& c : text) {
    const bool safe = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
    if (!safe) c = '-';
  }
  return text;
}

Scale ScaleFor(std::vector<double> values) {
  constexpr double kWideRange = 20.0;
  std::erase_if(values, [](double value) { return !(value > 0.0); });
  if (values.empty()) return Scale::kLinear;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most > kWideRange * *least ? Scale::kLogarithmic : Scale::kLinear;
}

Color VariantColor(std::size_t index) { return kRunColors[index % kRunColors.size()]; }

std::string ThreadsText(const std::vector<const RunRecord*>& runs) {
  std::set<int> threads;
  for (const RunRecord* run : runs) {
    if (run->provenance.contains("threads"))
      threads.insert(run->provenance.at("threads").get<int>());
  }
  if (threads.empty()) return "";
  return fmt::format(", {} thread{}", fmt::join(threads, " or "),
                     threads == std::set{1} ? "" : "s");
}

std::vector<std::string> ScenesOf(const std::vector<const RunRecord*>& runs) {
  std::vector<std::string> scenes;
  for (const RunRecord* run : runs) {
    if (std::find(scenes.begin(), scenes.end(), run->scene) == scenes.end())
      scenes.push_back(run->scene);
  }
  return scenes;
}

}  // namespace vitruvia
