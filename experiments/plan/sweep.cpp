#include "experiments/plan/sweep.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/message.h"

namespace vitruvia {
namespace {

constexpr const char* kMethodSettings = "method.settings.";
constexpr int kMostSteps = 10000;
constexpr double kMostPoints = 10000;

std::vector<std::string> KeysOf(const std::string& setting) {
  std::vector<std::string> keys{""};
  for (const char c : setting) {
    if (c == '.') {
      keys.emplace_back();
    } else {
      keys.back().push_back(c);
    }
  }
  return keys;
}

// { "fit": { "edge_px": 2 } } of the keys fit, edge_px and the value 2.
Json Nested(const std::vector<std::string>& keys, std::size_t first, const Json& value) {
  if (first == keys.size()) return value;
  return {{keys[first], Nested(keys, first + 1, value)}};
}

// Part of a folder's name; a path or a text with spaces keeps what can stand in one.
std::string NameOfValue(const Json& value) {
  std::string name = value.is_string() ? value.get<std::string>() : value.dump();
  for (char& c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' ||
                       c == '_' || c == '+';
    if (!plain) c = '_';
  }
  return name;
}

// Most sweeps are over settings of the method, so their prefix is left out.
std::string NameOfSetting(const std::string& setting) {
  const std::string prefix = kMethodSettings;
  return setting.starts_with(prefix) ? setting.substr(prefix.size()) : setting;
}

void Set(const std::string& setting, const Json& value, SweepPoint& point) {
  const std::vector<std::string> keys = KeysOf(setting);
  Json& overrides = keys.front() == "scene" ? point.scene : point.method;
  overrides = Merged(overrides, Nested(keys, 1, value));
}

// The point with each of the axis' values.
std::vector<SweepPoint> Along(const SweepAxis& axis, const SweepPoint& start) {
  std::vector<SweepPoint> points;
  for (const Json& value : ValuesOf(axis)) {
    const std::size_t index = points.size();
    SweepPoint& point = points.emplace_back(start);
    Set(axis.setting, value, point);
    for (const auto& [setting, values] : axis.along.items()) Set(setting, values[index], point);
    point.label += fmt::format(",{}={}", NameOfSetting(axis.setting), NameOfValue(value));
  }
  return points;
}

std::vector<SweepPoint> GridOf(const std::vector<SweepAxis>& axes) {
  std::vector<SweepPoint> points(1);
  for (const SweepAxis& axis : axes) {
    std::vector<SweepPoint> finer;
    for (const SweepPoint& point : points) {
      for (SweepPoint& next : Along(axis, point)) finer.push_back(std::move(next));
    }
    points = std::move(finer);
  }
  return points;
}

std::vector<SweepPoint> OneAtATime(const std::vector<SweepAxis>& axes) {
  std::vector<SweepPoint> points(1);
  for (const SweepAxis& axis : axes) {
    for (SweepPoint& point : Along(axis, SweepPoint())) points.push_back(std::move(point));
  }
  return points;
}

// "" if sweeps can change it.
std::string SettingProblem(const std::string& setting) {
  const std::vector<std::string> keys = KeysOf(setting);
  const bool named = keys.size() >= 2 && (keys[0] == "scene" || keys[0] == "method") &&
                     std::none_of(keys.begin(), keys.end(), [](auto& k) { return k.empty(); });
  if (!named)
    return fmt::format("setting: expected scene.KEY… or method.settings.KEY…, got \"{}\"", setting);
  if (setting == "scene.seed") return "setting: seeds have a list of their own: \"seeds\"";
  return "";
}

std::string ValuesProblem(const Json& values) {
  if (!values.is_array()) return "values: expected a list, got " + values.dump();
  for (const Json& value : values) {
    if (!value.is_primitive() || value.is_null())
      return fmt::format(
          "values: expected numbers, texts, true or false, got {} (a variant can override objects)",
          value.dump());
  }
  return "";
}

std::size_t CountOf(const SweepAxis& axis) {
  return axis.steps == 0 ? axis.values.size() : static_cast<std::size_t>(axis.steps);
}

std::string AlongProblem(const SweepAxis& axis) {
  if (!axis.along.is_object()) return "expected settings and lists of values";
  for (const auto& [setting, values] : axis.along.items()) {
    if (std::string problem = SettingProblem(setting); !problem.empty()) return problem;
    if (std::string problem = ValuesProblem(values); !problem.empty()) return problem;
    if (setting == axis.setting) return setting + ": the axis itself sets it";
    if (values.size() != CountOf(axis))
      return fmt::format("{}: expected a value for each of the {} of the axis, got {}", setting,
                         Counted(CountOf(axis), "value"), values.size());
  }
  return "";
}

}  // namespace

void SweepAxis::Describe(Fields& f) {
  f.Text("setting", setting,
         {.meaning = "the setting's path: scene.KEY…, or method.settings.KEY… (vitruvia explain)",
          .required = true});
  f.FreeJson("values", values, {.meaning = "values of the setting: numbers, texts, true or false"});
  f.Number("from", from, {.meaning = "first value of a range, instead of values"});
  f.Number("to", to, {.meaning = "last value of the range"});
  f.Integer("steps", steps,
            {.meaning = "number of values in the range, both ends included; 0: no range",
             .min = 0,
             .max = kMostSteps});
  f.Choice("scale", scale, {{"linear", SweepScale::kLinear}, {"log", SweepScale::kLogarithmic}},
           {.meaning = "spacing of the values in the range: equal differences or equal ratios; "
                       "also the scale of plots over the setting"});
  f.FreeJson("along", along,
             {.meaning = "other settings that change with it: path → list with one value for each "
                         "of the values"});
}

std::string SweepAxis::Problem() const {
  if (std::string problem = SettingProblem(setting); !problem.empty()) return problem;
  if (std::string problem = ValuesProblem(values); !problem.empty()) return problem;
  if (values.empty() && steps == 0) return "expected values, or a range: from, to and steps";
  if (!values.empty() && steps > 0) return "expected either values or a range, got both";
  if (steps == 1) return "steps: a range has at least its two ends, got 1";
  if (steps > 0 && scale == SweepScale::kLogarithmic && !(from > 0.0 && to > 0.0))
    return fmt::format("a log range: expected positive ends, got {} and {}", from, to);
  if (std::string problem = AlongProblem(*this); !problem.empty()) return "along: " + problem;
  return "";
}

void SweepSettings::Describe(Fields& f) {
  f.Choice("design", design,
           {{"grid", SweepDesign::kGrid}, {"one_at_a_time", SweepDesign::kOneAtATime}},
           {.meaning = "points of the sweep: all combinations of the axes' values; or the "
                       "defaults, then each value of each axis alone"});
  f.List("axes", axes, {.meaning = "settings and their values", .required = true});
}

std::string SweepSettings::Problem() const {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (axes[i].setting == axes[j].setting)
        return fmt::format("axes: the setting {} stands twice", axes[i].setting);
    }
  }
  double points = 1.0;
  for (const SweepAxis& axis : axes) points *= static_cast<double>(CountOf(axis));
  if (design == SweepDesign::kGrid && points > kMostPoints)
    return fmt::format("axes: the grid has {:g} points, expected at most {:g}", points,
                       kMostPoints);
  return "";
}

std::vector<Json> ValuesOf(const SweepAxis& axis) {
  if (axis.steps == 0) return axis.values.get<std::vector<Json>>();
  std::vector<Json> values;
  for (int i = 0; i < axis.steps; ++i) {
    const double share = static_cast<double>(i) / (axis.steps - 1);
    const double value = axis.scale == SweepScale::kLinear
                             ? axis.from + share * (axis.to - axis.from)
                             : axis.from * std::pow(axis.to / axis.from, share);
    // Twelve digits: 0.1, not 0.1 and the error of its computation.
    const double rounded = std::stod(fmt::format("{:.12g}", value));
    const bool whole = rounded == std::floor(rounded) && std::abs(rounded) < 1e9;
    values.push_back(whole ? Json(static_cast<int>(rounded)) : Json(rounded));
  }
  return values;
}

std::vector<SweepPoint> PointsOf(const SweepSettings& sweep) {
  return sweep.design == SweepDesign::kGrid ? GridOf(sweep.axes) : OneAtATime(sweep.axes);
}

}  // namespace vitruvia
