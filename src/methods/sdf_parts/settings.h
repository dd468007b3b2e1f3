#pragma once

#include "articulated/settings.h"
#include "config/settings.h"

namespace vitruvia::sdf_parts {

struct FieldSettings {
  double cell_m = 0.01;
  double margin_m = 0.1;
  double least_weight = 0.3;

  void Describe(Fields& fields);
};

struct ObservedSettings {
  double weight = 1.0;
  double first_cutoff_m = 0.1, last_cutoff_m = 0.05;
  double huber_m = 0.02;
  double facing_cosine = -0.1;

  void Describe(Fields& fields);
  std::string Problem() const;
};

struct PredictedSettings {
  double weight = 0.2;
  int stride_px = 4;
  double occupied_m = 0.03;
  double cutoff_m = 0.08;

  void Describe(Fields& fields);
};

struct IntersectionSettings {
  double weight = 0.0;
  double samples_per_m2 = 2000.0;

  void Describe(Fields& fields);
};

struct Settings {
  articulated::CommonSettings common;
  FieldSettings field;
  ObservedSettings observed;
  PredictedSettings predicted;
  IntersectionSettings intersection;

  void Describe(Fields& fields);
  std::string Problem() const;
};

}  // namespace vitruvia::sdf_parts
