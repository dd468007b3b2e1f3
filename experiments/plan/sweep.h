// Sweeps: values of settings from which an experiment file makes variants.
//
//   "sweep": {
//     "design": "grid",
//     "axes": [
//       {"setting": "method.settings.fit.edge_px", "values": [1, 2, 4]},
//       {"setting": "scene.view.camera.fx", "from": 71.25, "to": 285, "steps": 3, "scale": "log"}
//     ]
//   }
//
// Each variant of the experiment is run with each point of the sweep, whose label is appended to
// the variant's name: "default,fit.edge_px=2,scene.frames=30". "scale" is also the scale of plots
// over the setting. Settings that must change with it go along, one value for each of its values:
//
//   {"setting": "scene.motion.speed", "values": [1, 2], "along": {"scene.frames": [240, 120]}}
#pragma once

#include <string>
#include <vector>

#include "config/json_settings.h"
#include "records/run_record.h"

namespace vitruvia {

// The values that one setting takes: a list, or a range with both its ends.
struct SweepAxis {
  std::string setting;  // "scene.…" or "method.…", keys joined by dots
  Json values = Json::array();
  double from = 0.0, to = 0.0;
  int steps = 0;  // 0: no range
  SweepScale scale = SweepScale::kLinear;
  Json along = Json::object();  // other settings → a value for each of `values`

  void Describe(Fields& fields);
  std::string Problem() const;
};

enum class SweepDesign {
  kGrid,        // every combination of the axes' values
  kOneAtATime,  // nothing changed, then each value of each axis alone
};

struct SweepSettings {
  SweepDesign design = SweepDesign::kGrid;
  std::vector<SweepAxis> axes;  // none: no sweep

  void Describe(Fields& fields);
  std::string Problem() const;
};

// Overrides (RFC 7386 merge patches), as in a variant, and their label.
struct SweepPoint {
  std::string label;  // suffix of the variant's name, ",fit.edge_px=2"; "" if nothing is changed
  Json scene = Json::object(), method = Json::object();
};

// In order: the last axis changes fastest. One point that changes nothing if there are no axes.
std::vector<SweepPoint> PointsOf(const SweepSettings& sweep);

// The values that an axis takes, in order.
std::vector<Json> ValuesOf(const SweepAxis& axis);

}  // namespace vitruvia
