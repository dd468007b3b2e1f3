#pragma once

#include "articulated/settings.h"
#include "config/settings.h"

namespace vitruvia::capsule_icp {

// The correspondences of the data term.
enum class DataTermKind {
  kClosestPoint,     // Ganapathi 2012: each observed point to its nearest capsule
  kDepthDifference,  // Wei 2012: at each rendered pixel the difference of observed and model depth
};

struct CapsuleSettings {
  int trunk_capsules = 2;
  double sample_spacing_m = 0.05;

  void Describe(Fields& fields);
};

struct MatchSettings {
  double first_cutoff_m = 0.2, last_cutoff_m = 0.06;
  double facing_cosine = 0.2;

  void Describe(Fields& fields);
  std::string Problem() const;
};

struct SilhouetteSettings {
  double weight = 0.01;
  int reach_px = 24;

  void Describe(Fields& fields);
};

struct FreeSpaceSettings {
  double weight = 0.01;
  double margin_m = 0.03;
  double reach_m = 0.15;

  void Describe(Fields& fields);
};

struct Settings {
  articulated::CommonSettings common;
  CapsuleSettings capsules;
  DataTermKind data_term = DataTermKind::kClosestPoint;
  MatchSettings match;
  SilhouetteSettings silhouette;
  FreeSpaceSettings free_space;
  double intersection_weight = 10.0;

  void Describe(Fields& fields);
};

}  // namespace vitruvia::capsule_icp
