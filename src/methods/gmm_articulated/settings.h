#pragma once

#include "articulated/settings.h"
#include "config/settings.h"

namespace vitruvia::gmm_articulated {

struct Settings {
  articulated::CommonSettings common;
  double first_sigma_m = 0.04;
  double outlier_share = 0.05;
  double reach_sigmas = 3.0;

  Settings() { common.stopping.iterations = 12; }
  void Describe(Fields& fields);
};

}  // namespace vitruvia::gmm_articulated
